#!/bin/sh
# driver.sh PARAMS RESULTS: one design of Dakota. EK_DECK is the path of the deck, for instance export EK_DECK=$HOME/axle.nml
set -e
dprepro "$1" settings.template settings.in
elastokin run "$EK_DECK" --quiet --set-file settings.in --responses left_braking_deflection,left_bump_steer --results "$2"
