/* The system: files, folders, processes, signals, clocks, loaded libraries. Constants and structures of the system are those of its
   own headers. src/os/ek_system_call.f90 declares these functions for Fortran, and the other modules of src/os use them.

   Two halves: POSIX, and WASI (WebAssembly), which has no processes, signals, locks or links. There, flang passes numbers of 32 and
   64 bits and addresses, so no function has an argument of another width.

   Paths end with a null character. A text is returned in `letters`, without a null character, and cut at `size`; the result is its
   length. After a failure, errno is unchanged until ek_os_text(reason, …). */
#define _GNU_SOURCE
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>
#ifndef __wasi__
#include <dlfcn.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/wait.h>
#endif

/* Numbers that ek_system_call.f90 names too */
enum { done = 0, failed = -1, already_there = -2, try_again = -3, broken_pipe = -4 };
enum { unknown_file = -1, no_file, regular_file, folder_file, device_file, link_file, other_file };
enum { to_read, to_write, to_update, to_append, to_try_pipe, to_hold_folder, to_create };
enum { reason, host_name, working_folder, program_path };
enum { has_ended, no_log, not_started, too_late, stopped };

#define UNUSED(argument) ((void)(argument))
#define COUNT(list) (sizeof (list)/sizeof *(list))

static int32_t give(const char *text, char *letters, int32_t size) {
  size_t length = text ? strlen(text) : 0;
  if (length > (size_t)size) length = (size_t)size;
  if (length > 0) memcpy(letters, text, length);
  return (int32_t)length;
}

/* ---- files ---------------------------------------------------------------------------------------------------------- */

/* Kind of a path; inode, device and last change [s since 1970] in `facts`. Of a link, that of its target with `follow`. */
int32_t ek_os_facts(const char *path, int32_t follow, int64_t facts[3]) {
  struct stat found;
  memset(facts, 0, 3*sizeof *facts);
  if ((follow ? stat(path, &found) : lstat(path, &found)) != 0)
    return errno == ENOENT || errno == ENOTDIR ? no_file : unknown_file;
  facts[0] = (int64_t)found.st_ino;
  facts[1] = (int64_t)found.st_dev;
  facts[2] = (int64_t)found.st_mtime;
  return S_ISREG(found.st_mode) ? regular_file : S_ISDIR(found.st_mode) ? folder_file :
    S_ISCHR(found.st_mode) || S_ISBLK(found.st_mode) ? device_file : S_ISLNK(found.st_mode) ? link_file : other_file;
}

/* Opens a file or folder, which other programs that this process starts do not see. A pipe is opened without waiting for the
   program at its other end. */
int32_t ek_os_open(const char *path, int32_t purpose) {
  static const int flags[] = {
    [to_read] = O_RDONLY | O_NONBLOCK, [to_write] = O_WRONLY | O_CREAT | O_TRUNC, [to_update] = O_RDWR,
    [to_append] = O_WRONLY | O_CREAT | O_APPEND, [to_try_pipe] = O_WRONLY | O_NONBLOCK, [to_hold_folder] = O_RDONLY | O_DIRECTORY,
    [to_create] = O_WRONLY | O_CREAT | O_EXCL};     /* O_EXCL does not follow a link planted under the name */
  int wanted = flags[purpose] | O_CLOEXEC, file;
#ifdef __wasi__
  wanted &= ~O_NONBLOCK;     /* there are no pipes, and not every host accepts it */
#endif
  file = open(path, wanted, 0666);
  return file >= 0 ? file : errno == EEXIST ? already_there : failed;
}

/* Number of bytes read; 0 at the end, `try_again` from a pipe that is empty */
int32_t ek_os_read(int32_t file, char *bytes, int32_t size) {
  ssize_t got;
  do got = read(file, bytes, (size_t)size); while (got < 0 && errno == EINTR);
  return got >= 0 ? (int32_t)got : errno == EAGAIN ? try_again : failed;
}

int32_t ek_os_write(int32_t file, const char *bytes, int64_t count) {
  while (count > 0) {
    ssize_t now = write(file, bytes, (size_t)count);
    if (now < 0 && errno == EINTR) continue;
    if (now < 1) return errno == EPIPE ? broken_pipe : failed;
    bytes += now;
    count -= now;
  }
  return done;
}

/* Waits until a file is on the disk; `done` also if the file system cannot. */
int32_t ek_os_sync(int32_t file) {
#ifdef __wasi__
  fsync(file);     /* not every host can, above all for folders; nothing is lost, as there is no disk to wait for */
  return done;
#else
  return fsync(file) == 0 || errno == EINVAL ? done : failed;
#endif
}

/* Whether a file could be locked. The lock ends when the file is closed or the process ends. */
int32_t ek_os_lock(int32_t file) {     /* try_again: another process holds the lock; failed: this file has no locks */
#ifdef __wasi__
  UNUSED(file);     /* one instance has its files to itself */
  return done;
#else
  return flock(file, LOCK_EX | LOCK_NB) == 0 ? done : errno == EWOULDBLOCK ? try_again : failed;
#endif
}

int32_t ek_os_is_folder(const char *path) {     /* that can be entered */
  struct stat found;
  if (stat(path, &found) != 0 || !S_ISDIR(found.st_mode)) return 0;
#ifdef __wasi__
  return 1;
#else
  return access(path, X_OK) == 0;
#endif
}

int32_t ek_os_exists(const char *path) {
#ifdef __wasi__
  struct stat found;
  return stat(path, &found) == 0;
#else
  return access(path, F_OK) == 0;
#endif
}

int32_t ek_os_can_start(const char *path) {
#ifdef __wasi__
  UNUSED(path);
  return 0;
#else
  return access(path, X_OK) == 0;
#endif
}

int32_t ek_os_make_folder(const char *path, int32_t is_private) {
  return mkdir(path, is_private ? 0700 : 0777) == 0 ? done : errno == EEXIST ? already_there : failed;
}

int32_t ek_os_make_link(const char *target, const char *path) {
#ifdef __wasi__
  UNUSED(target);
  UNUSED(path);
  errno = ENOSYS;
  return failed;
#else
  return symlink(target, path);
#endif
}

int64_t ek_os_open_folder(const char *path) { return (int64_t)(intptr_t)opendir(path); }     /* 0 if it cannot be read */

int32_t ek_os_next_name(int64_t folder, char *letters, int32_t size) {     /* 0 after the last name */
  const struct dirent *entry;
  while ((entry = readdir((DIR *)(intptr_t)folder))) {
    const char *name = entry->d_name;
    if (strcmp(name, ".") != 0 && strcmp(name, "..") != 0 && strlen(name) <= (size_t)size) return give(name, letters, size);
  }
  return 0;
}

void ek_os_close_folder(int64_t folder) { closedir((DIR *)(intptr_t)folder); }

/* ---- the machine ---------------------------------------------------------------------------------------------------- */

int32_t ek_os_text(int32_t what, char *letters, int32_t size) {
  char text[4096];
  ssize_t length;
  memset(text, 0, sizeof text);
  switch (what) {
  case reason: return give(strerror(errno), letters, size);
  case working_folder: return give(getcwd(text, sizeof text), letters, size);
  case program_path:
    length = readlink("/proc/self/exe", text, sizeof text - 1);     /* Linux */
    return length < 1 ? 0 : give(text, letters, size);
  case host_name:
#ifdef __wasi__
    return give("wasm", letters, size);
#else
    return gethostname(text, 64) == 0 ? give(text, letters, size) : 0;
#endif
  }
  return 0;
}

int32_t ek_os_random(char *bytes, int32_t count) { return getentropy(bytes, (size_t)count) == 0 ? done : failed; }

int64_t ek_os_time(void) { return (int64_t)time(NULL); }

int32_t ek_os_date(int64_t seconds, int32_t is_local, const char *form, char *letters, int32_t size) {     /* form: of strftime */
  char text[64];
  time_t moment = (time_t)seconds;
  struct tm fields;
  if (!(is_local ? localtime_r(&moment, &fields) : gmtime_r(&moment, &fields))) return 0;
  return strftime(text, sizeof text, form, &fields) > 0 ? give(text, letters, size) : 0;
}

void ek_os_sleep(int32_t milliseconds) {     /* ends early when a signal arrives */
  struct timespec duration = {milliseconds/1000, (milliseconds % 1000)*1000000L};
  nanosleep(&duration, NULL);
}

#ifdef __wasi__

/* ---- WASI: no libraries are loaded, no process is started, no signal arrives ---------------------------------------- */

int32_t ek_os_has_symbol(const char *name) { UNUSED(name); return 0; }
int32_t ek_os_library_with(const char *symbol, char *letters, int32_t size) { UNUSED(symbol); return give(NULL, letters, size); }
int32_t ek_os_text_of(const char *name, char *letters, int32_t size) { UNUSED(name); return give(NULL, letters, size); }
void ek_os_call(const char *name, int32_t argument) { UNUSED(name); UNUSED(argument); }

int32_t ek_os_run(const char *arguments, int32_t count, const char *folder, const char *log, int32_t limit, int32_t *status) {
  UNUSED(arguments); UNUSED(count); UNUSED(folder); UNUSED(log); UNUSED(limit);
  *status = 127;
  errno = ENOSYS;
  return not_started;
}

void ek_os_become(const char *arguments, int32_t count) { UNUSED(arguments); UNUSED(count); errno = ENOSYS; }
void ek_os_watch(void) {}
int32_t ek_os_is_asked(void) { return 0; }
int32_t ek_os_stop_signal(void) { return 0; }
void ek_os_obey(void) {}
void ek_os_prepare(void) {}

#else

/* ---- POSIX: loaded libraries ---------------------------------------------------------------------------------------- */

static void (*procedure_named(const char *name))(void) {     /* copied: ISO C converts no address of data to that of a procedure */
  void *address = dlsym(RTLD_DEFAULT, name);
  void (*procedure)(void) = NULL;
  memcpy(&procedure, &address, sizeof procedure);
  return procedure;
}

int32_t ek_os_has_symbol(const char *name) { return dlsym(RTLD_DEFAULT, name) != NULL; }

/* Path of the loaded library, or of the program, that contains a symbol */
int32_t ek_os_library_with(const char *symbol, char *letters, int32_t size) {
  void *address = dlsym(RTLD_DEFAULT, symbol);
  Dl_info facts;
  return address && dladdr(address, &facts) != 0 ? give(facts.dli_fname, letters, size) : 0;
}

/* The text that `const char *name(void)` of a loaded library returns */
int32_t ek_os_text_of(const char *name, char *letters, int32_t size) {
  const char *(*procedure)(void) = (const char *(*)(void))procedure_named(name);
  return procedure ? give(procedure(), letters, size) : 0;
}

/* Calls `void name(int)` of a loaded library. */
void ek_os_call(const char *name, int32_t argument) {
  void (*procedure)(int) = (void (*)(int))procedure_named(name);
  if (procedure) procedure(argument);
}

/* ---- POSIX: signals ------------------------------------------------------------------------------------------------- */

static const int signals[] = {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGUSR1, SIGUSR2, SIGXCPU};
static volatile sig_atomic_t is_asked, latest;     /* a stop since ek_os_watch; signal since a wait began, 0: none */
static int is_watching;

static void note_stop(int number) {
  is_asked = 1;
  latest = number;
  signal(number, SIG_DFL);
}

/* A signal that was ignored before, as SIGHUP is by nohup, stays ignored, except the first `always` signals. */
static void handle_signals(size_t always, void (*action)(int)) {
  for (size_t k = 0; k < COUNT(signals); k++)
    if (signal(signals[k], action) == SIG_IGN && k >= always) signal(signals[k], SIG_IGN);
}

void ek_os_watch(void) {
  is_asked = 0;
  is_watching = 1;
  handle_signals(2, note_stop);
}

int32_t ek_os_is_asked(void) { return is_asked; }
int32_t ek_os_stop_signal(void) { return latest; }

void ek_os_obey(void) {     /* ends this process by the signal of the last wait, unless the run itself watches */
  if (latest != 0 && !is_watching) raise(latest);
}

/* A pipe whose reader has gone, and a file at `ulimit -f`, become errors of a write. Descriptors 0 to 2 are opened if they are
   closed: no other file may get these numbers. */
void ek_os_prepare(void) {
  signal(SIGPIPE, SIG_IGN);
  signal(SIGXFSZ, SIG_IGN);
  for (int file = 0; file <= 2; file++)     /* open takes the lowest free number: this one. Reading, or writing, fails as before */
    if (fcntl(file, F_GETFD) < 0 && open("/dev/null", file == 0 ? O_WRONLY : O_RDONLY) < 0) return;
}

/* ---- POSIX: other programs ------------------------------------------------------------------------------------------ */

static char **list_of(const char *arguments, int32_t count) {     /* each argument ends with a null character; NULL: no memory */
  char **list = calloc((size_t)count + 1, sizeof *list);
  for (int32_t k = 0; list && k < count; k++, arguments += strlen(arguments) + 1) list[k] = (char *)(uintptr_t)arguments;
  return list;
}

static int64_t milliseconds(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (int64_t)now.tv_sec*1000 + now.tv_nsec/1000000;
}

/* Waits for a process to end, and kills its group at the time limit [s] or when a signal arrives. */
static int32_t wait_for(pid_t process, int32_t limit, int32_t *status) {
  const int64_t deadline = milliseconds() + (int64_t)limit*1000;
  int32_t outcome = has_ended, nap = 1;
  int word = 0;
  *status = 0;     /* also if the status was collected elsewhere: what the program wrote decides */
  for (;;) {
    pid_t found = waitpid(process, &word, WNOHANG);
    if (found == process) break;
    if (found < 0 && errno != EINTR) return has_ended;
    if (found < 0) continue;
    if (milliseconds() > deadline || latest != 0) {
      kill(-process, SIGKILL);
      while (waitpid(process, &word, 0) < 0 && errno == EINTR) continue;
      outcome = latest != 0 ? stopped : too_late;
      break;
    }
    ek_os_sleep(nap);
    nap = nap < 10 ? 2*nap : 20;
  }
  *status = WIFSIGNALED(word) ? 128 + WTERMSIG(word) : WEXITSTATUS(word);
  return outcome;
}

/* Runs a program in `folder` as a process group, with output to `log` and empty input. An alarm ends it soon after the limit [s] if
   this process is killed. */
int32_t ek_os_run(const char *arguments, int32_t count, const char *folder, const char *log, int32_t limit, int32_t *status) {
  char **list = list_of(arguments, count);
  int output = open(log, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666), input = open("/dev/null", O_RDONLY | O_CLOEXEC), why;
  int32_t outcome = no_log;
  pid_t process;
  *status = 127;
  if (list && output >= 0 && input >= 0) {
    latest = 0;
    if (!is_watching) handle_signals(0, note_stop);
    process = fork();
    if (process == 0) {     /* from here to execvp only system calls are allowed */
      setpgid(0, 0);
      signal(SIGPIPE, SIG_DFL);
      signal(SIGALRM, SIG_DFL);
      alarm((unsigned)limit + 5);
      dup2(input, 0);
      dup2(output, 1);
      dup2(output, 2);
      if (chdir(folder) == 0) execvp(list[0], list);
      _exit(127);
    }
    why = errno;
    outcome = not_started;
    if (process > 0) {
      setpgid(process, process);     /* parent and child both set it: whichever runs first */
      outcome = wait_for(process, limit, status);
    }
    if (!is_watching) handle_signals(0, SIG_DFL);
  } else {
    why = errno;
  }
  if (output >= 0) close(output);
  if (input >= 0) close(input);
  free(list);
  errno = why;
  return outcome;
}

/* Replaces this process by another program; returns only if it cannot be started. */
void ek_os_become(const char *arguments, int32_t count) {
  char **list = list_of(arguments, count);
  if (list) execvp(list[0], list);
  free(list);
}

#endif
