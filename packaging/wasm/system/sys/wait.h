/* sys/wait.h for the Fortran runtime on WASI, where no process can be started: every process has ended with status 0. */
#ifndef EK_SYS_WAIT_H
#define EK_SYS_WAIT_H
#define WIFEXITED(status) ((void)(status), 1)
#define WEXITSTATUS(status) ((void)(status), 0)
#define WIFSIGNALED(status) ((void)(status), 0)
#define WTERMSIG(status) ((void)(status), 0)
#endif
