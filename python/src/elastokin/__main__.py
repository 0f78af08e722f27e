"""python -m elastokin: the command line."""

from elastokin_command import main

main()
