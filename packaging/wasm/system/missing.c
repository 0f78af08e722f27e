/* Functions that the Fortran runtime calls and wasi-libc does not have: there are no processes and no users. */
#include "missing.h"
#include <errno.h>
#include <string.h>

static int not_here(void) { errno = ENOSYS; return -1; }

int fork(void) { return not_here(); }
int setsid(void) { return not_here(); }
int execl(const char *path, const char *word, ...) { (void)path; (void)word; return not_here(); }
int system(const char *command) { return command ? not_here() : 0; }
int mkstemp(char *template_) { (void)template_; return not_here(); }
int getlogin_r(char *letters, size_t size) { (void)letters; (void)size; return ENOSYS; }
unsigned getuid(void) { return 0; }
unsigned getgid(void) { return 0; }

int gethostname(char *letters, size_t size) {
  static const char name[] = "wasm";
  if (size < sizeof name) { errno = EINVAL; return -1; }
  memcpy(letters, name, sizeof name);
  return 0;
}
