/* Functions that the Fortran runtime calls and wasi-libc does not have; system/missing.c defines them. Included before every file
   of the runtime: flang's ISO_Fortran_binding_wrapper.h includes stdint.h within a namespace, so stdint.h is read here before. */
#ifndef EK_MISSING_H
#define EK_MISSING_H
#include <stddef.h>
#include <stdint.h>
#ifdef __cplusplus
extern "C" {
#endif
int fork(void);
int setsid(void);
int execl(const char *path, const char *word, ...);
int system(const char *command);
int mkstemp(char *template_);
int gethostname(char *letters, size_t size);
int getlogin_r(char *letters, size_t size);
unsigned getuid(void);
unsigned getgid(void);
void _exit(int status) __attribute__((noreturn));
#ifdef __cplusplus
}
namespace std { using ::system; }
#endif
#endif
