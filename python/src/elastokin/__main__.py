"""python -m elastokin: the command line."""

from ._command import main

main()
