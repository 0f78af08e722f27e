/* Room for temporary values inside loops, of which retarget.py makes calls. */
#include <stdint.h>
#include <stdlib.h>

/* Room of `size` bytes in place of `old`, which is null or of the previous pass of the loop. */
void *ek_renew_room(void *old, int64_t size) {
  void *room = size < 0 || size > INT32_MAX ? NULL : realloc(old, (size_t)size + 1);
  if (!room) __builtin_trap();     /* as a full stack */
  return room;
}

void ek_release_room(void *room) { free(room); }
