"""python -m elastokin_wasm: the command line."""
from elastokin_wasm import main

main()
