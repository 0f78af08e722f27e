/* Entry of elastokin.wasm. One file, two uses: `_start` runs the command line, as in any WASI program; `ek_initialize` prepares an
   instance of which the functions of elastokin.h are called. */
#include <stdlib.h>
#include <unistd.h>

int ek_fortran_main(int count, char **words, char **environment);     /* the main program, renamed by retarget.py */
extern char **environ;
void __wasm_call_ctors(void);
void __wasm_call_dtors(void);
int __main_void(void);                                                /* calls main with the arguments of the command line */

int main(int count, char **words) {
  const char *folder = getenv("PWD");     /* WASI has no working folder; one that does not exist is met at the first file */
  if (folder && chdir(folder) != 0) chdir("/");
  return ek_fortran_main(count, words, environ);
}

__attribute__((export_name("ek_initialize"))) void ek_initialize(void) { __wasm_call_ctors(); }

/* Relative names of files start from a folder from now on; 0, or -1 if it does not exist */
__attribute__((export_name("ek_enter"))) int ek_enter(const char *folder) { return chdir(folder); }

__attribute__((export_name("_start"))) void _start(void) {
  int status;
  __wasm_call_ctors();
  status = __main_void();
  if (status != 0) exit(status);
  __wasm_call_dtors();
}
