/* pthread.h for the Fortran runtime on WASI, which has one thread: a lock only notes that it is held. */
#ifndef EK_PTHREAD_H
#define EK_PTHREAD_H

/* wasi-libc declares these types without the functions */
typedef int ek_mutex_t;
typedef int ek_thread_t;
#define pthread_mutex_t ek_mutex_t
#define pthread_t ek_thread_t

enum { ek_is_held = 16 };     /* EBUSY */

static inline int pthread_mutex_init(ek_mutex_t *mutex, const void *attributes) {
  (void)attributes;
  *mutex = 0;
  return 0;
}
static inline int pthread_mutex_destroy(ek_mutex_t *mutex) { (void)mutex; return 0; }
static inline int pthread_mutex_lock(ek_mutex_t *mutex) { *mutex = 1; return 0; }
static inline int pthread_mutex_unlock(ek_mutex_t *mutex) { *mutex = 0; return 0; }
static inline int pthread_mutex_trylock(ek_mutex_t *mutex) {
  if (*mutex) return ek_is_held;
  *mutex = 1;
  return 0;
}
static inline ek_thread_t pthread_self(void) { return 1; }
static inline int pthread_equal(ek_thread_t one, ek_thread_t other) { return one == other; }

#endif
