#!/bin/sh
# driver.sh PARAMS RESULTS: one design of Dakota. EK_DECK is the path of the deck, for instance export EK_DECK=$HOME/axle.nml
exec elastokin run "$EK_DECK" --quiet --set-file "$1" --responses left_braking_deflection,left_bump_steer --results "$2"
