/* The functions of POSIX that the module ek_posix names, on WASI, with the constants and structures of Linux that the program
   expects. retarget.py calls ekw_X where the program calls X, for every X defined here. What WASI does not have fails with a reason:
   no process is started, no signal arrives, no link is made. */
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#define COUNT(list) (sizeof (list)/sizeof *(list))
#define UNUSED(argument) ((void)(argument))

static int not_here(void) { errno = ENOSYS; return -1; }

/* ---- errno: numbers of Linux; a number that is not in the list is shown as 1000 and the number of WASI ---- */

static const struct { int here, in_linux; } numbers[] = {
  {EPERM, 1}, {ENOENT, 2}, {EINTR, 4}, {EIO, 5}, {EBADF, 9}, {ECHILD, 10}, {EAGAIN, 11}, {ENOMEM, 12}, {EACCES, 13}, {EEXIST, 17},
  {EXDEV, 18}, {ENOTDIR, 20}, {EISDIR, 21}, {EINVAL, 22}, {EMFILE, 24}, {EFBIG, 27}, {ENOSPC, 28}, {ESPIPE, 29}, {EROFS, 30},
  {EPIPE, 32}, {ENAMETOOLONG, 36}, {ENOSYS, 38}, {ENOTEMPTY, 39}, {ELOOP, 40}};
enum { not_in_list = 1000 };

int *ekw___errno_location(void) {
  static int shown;
  shown = errno == 0 ? 0 : not_in_list + errno;
  for (unsigned k = 0; k < COUNT(numbers); k++) if (numbers[k].here == errno) shown = numbers[k].in_linux;
  return &shown;
}

char *ekw_strerror(int number) {
  for (unsigned k = 0; k < COUNT(numbers); k++) if (numbers[k].in_linux == number) return strerror(numbers[k].here);
  return strerror(number - not_in_list);
}

/* ---- files ---- */

int ekw_open(const char *path, int flags) {     /* the program opens only to read: files are written through streams */
  UNUSED(flags);
  return open(path, O_RDONLY);
}

int ekw_fsync(int file) {     /* not every host can, above all for folders; nothing is lost, as there is no disk to wait for */
  fsync(file);
  return 0;
}

int ekw_flock(int file, int operation) {     /* one instance has its files to itself */
  UNUSED(file);
  UNUSED(operation);
  return 0;
}

/* Some hosts find 'file/.'. Nothing can be executed */
int ekw_access(const char *path, int mode) {
  size_t length = strlen(path);
  struct stat facts;
  char folder[4096];
  if (stat(path, &facts) != 0) return -1;
  if (length > 2 && length < sizeof folder && strcmp(path + length - 2, "/.") == 0) {
    memcpy(folder, path, length - 2);
    folder[length - 2] = 0;
    if (stat(folder, &facts) != 0) return -1;
    if (!S_ISDIR(facts.st_mode)) { errno = ENOTDIR; return -1; }
  }
  if (mode & 1 && !S_ISDIR(facts.st_mode)) { errno = EACCES; return -1; }
  return 0;
}

int ekw_symlink(const char *from, const char *to) { UNUSED(from); UNUSED(to); return not_here(); }

/* ---- folders: struct dirent with the name at offset 19, and with '.', which some hosts omit ---- */

enum { name_offset = 19, longest_name = 1024 };
static char entry[name_offset + longest_name + 1];
static DIR *fresh;

DIR *ekw_opendir(const char *path) { return fresh = opendir(path); }

char *ekw_readdir(DIR *folder) {
  struct dirent *found;
  if (folder == fresh) {
    fresh = NULL;
    strcpy(entry + name_offset, ".");
    return entry;
  }
  do found = readdir(folder); while (found && (strcmp(found->d_name, ".") == 0 || strlen(found->d_name) > longest_name));
  if (!found) return NULL;
  strcpy(entry + name_offset, found->d_name);
  return entry;
}

/* ---- functions that the program looks up when it runs. flang passes the lengths of strings after the arguments ---- */

/* struct statx as ek_system reads it */
static int statx_of(int folder, const char *path, int flags, int mask, char *facts, int64_t path_length, int64_t facts_length) {
  enum { no_follow = 256, mode_at = 28, inode_at = 32, changed_at = 112, major_at = 136, minor_at = 140 };
  struct stat found;
  uint16_t mode;
  uint64_t inode;
  int64_t changed;
  uint32_t major, minor;
  UNUSED(folder); UNUSED(mask); UNUSED(path_length); UNUSED(facts_length);
  if ((flags & no_follow ? lstat(path, &found) : stat(path, &found)) != 0) return -1;
  mode = S_ISREG(found.st_mode) ? 0100000 : S_ISDIR(found.st_mode) ? 0040000 : S_ISCHR(found.st_mode) ? 0020000 :
    S_ISBLK(found.st_mode) ? 0060000 : S_ISLNK(found.st_mode) ? 0120000 : 0140000;
  inode = found.st_ino;
  changed = found.st_mtim.tv_sec;
  major = (uint32_t)(found.st_dev >> 31) & 0x7fffffff;
  minor = (uint32_t)found.st_dev & 0x7fffffff;
  memcpy(facts + mode_at, &mode, sizeof mode);
  memcpy(facts + inode_at, &inode, sizeof inode);
  memcpy(facts + changed_at, &changed, sizeof changed);
  memcpy(facts + major_at, &major, sizeof major);
  memcpy(facts + minor_at, &minor, sizeof minor);
  return 0;
}

static int entropy_of(char *bytes, int64_t count, int64_t length) { UNUSED(length); return getentropy(bytes, (size_t)count); }

void *ekw_dlsym(void *handle, const char *name) {
  UNUSED(handle);
  if (strcmp(name, "statx") == 0) return (void *)statx_of;
  if (strcmp(name, "getentropy") == 0) return (void *)entropy_of;
  return NULL;
}

int ekw_dladdr(void *address, void *facts) { UNUSED(address); UNUSED(facts); return 0; }

/* ---- processes, signals, terminals: none ---- */

int ekw_fork(void) { return not_here(); }
int ekw_execvp(const char *file, void *words) { UNUSED(file); UNUSED(words); return not_here(); }
int ekw_setpgid(int process, int group) { UNUSED(process); UNUSED(group); return not_here(); }
int ekw_kill(int process, int number) { UNUSED(process); UNUSED(number); return not_here(); }
int ekw_raise(int number) { UNUSED(number); return not_here(); }
int ekw_alarm(int seconds) { UNUSED(seconds); return 0; }
void *ekw_signal(int number, void *action) { UNUSED(number); UNUSED(action); return NULL; }
int ekw_dup(int file) { UNUSED(file); return 1000000; }     /* whether a standard stream is open: it is. The copy is only closed */
int ekw_dup2(int from, int to) { UNUSED(from); UNUSED(to); return not_here(); }

int ekw_waitpid(int process, int *status, int options) {
  UNUSED(process); UNUSED(status); UNUSED(options);
  errno = ECHILD;
  return -1;
}

int ekw_poll(void *list, int64_t count, int milliseconds) {     /* only ever waited with */
  struct timespec duration = {milliseconds/1000, (milliseconds % 1000)*1000000L};
  UNUSED(list); UNUSED(count);
  return nanosleep(&duration, NULL);
}

int ekw_gethostname(char *letters, int64_t size) {
  static const char name[] = "wasm";
  if (size < (int64_t)sizeof name) { errno = EINVAL; return -1; }
  memcpy(letters, name, sizeof name);
  return 0;
}
