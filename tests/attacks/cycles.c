/* cycles DECK CASE N: opens, changes, solves, copies and closes a deck N times, with a mistake in between, and prints by how many bytes the memory
 * grew after the first tenth. Status 0 if the heap grew by less than a byte per cycle. */
#include <elastokin.h>
#include <malloc.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* VmRSS [bytes] */
static long resident(void) {
  char line[200];
  long kilobytes = -1;
  FILE *file = fopen("/proc/self/status", "r");
  while (file && fgets(line, sizeof line, file)) sscanf(line, "VmRSS: %ld", &kilobytes);
  if (file) fclose(file);
  return 1024 * kilobytes;
}

static void require(int holds, const char *what, ek_model *model) {
  if (holds) return;
  fprintf(stderr, "cycles: %s: %s\n", what, model ? ek_message(model) : "");
  exit(1);
}

static void cycle(const char *deck, const char *name, double *values, int room) {
  ek_model *model, *copy, *other;
  const char *number, *column, *path, *text;
  double value;
  int n, k;

  require(ek_open_file(deck, &model) == EK_OK, "open", model);
  require(ek_get(model, ek_parameter_path(model, 0), &value) == EK_OK, "get", model);
  require(ek_set(model, "no.such.number", 1.0) == EK_USAGE, "an unknown path", model);
  require(strlen(ek_message(model)) > 0, "a message", model);
  require(ek_set_text(model, "bushing.*.kt(1)", "*1.1") == EK_OK, "set", model);
  require(ek_solve(model, name, 0, NULL) == EK_OK, "solve", model);
  n = ek_row_count(model) * ek_column_count(model);
  require(n > 0 && n <= room && ek_values(model, n, values) == EK_OK, "values", model);
  for (k = 0; k < ek_column_count(model); k++) require(ek_column_name(model, k) && ek_column_unit(model, k), "column", model);
  require(ek_compliance(model, 0, 36 * ek_wheel_count(model) * ek_wheel_count(model), values) == EK_OK, "compliance", model);
  require(ek_body_name(model, 0) && ek_poses(model, 0, 12 * ek_body_count(model), values) == EK_OK, "poses", model);
  number = ek_parameter_path(model, 0);
  column = ek_column_name(model, 2);
  require(ek_derivatives(model, 0, 1, &column, 1, &number, &value, NULL) != EK_FILE, "derivatives", model);
  require(ek_set_text(model, "bushing.*.kt(1)", "*1.1") == EK_OK, "a text after a solution", model);
  require(ek_values(model, n, values) == EK_OK, "values stay", model);
  require(ek_derivatives(model, 0, 1, &column, 1, &number, &value, NULL) != EK_FILE, "derivatives stay", model);
  require(ek_solve(model, name, 0, NULL) == EK_OK, "solve again", model);
  require(ek_set(model, "bushing.*.kt(1)", -1.0) == EK_DECK, "an illegal number", model);
  require(ek_copy(model, &copy) == EK_OK, "copy", model);
  require(ek_deck_as_used(copy) != NULL, "deck as used", copy);
  path = ek_file_path(copy, 0);
  text = ek_file_text(copy, 0);
  require(ek_open_files(1, &path, &text, &other) == EK_OK, "open files", other);
  ek_close(other);
  ek_close(copy);
  require(ek_reset(model) == EK_OK, "reset", model);
  require(ek_solve(model, "no such case", 0, NULL) == EK_USAGE, "an unknown case", model);
  ek_close(model);

  require(ek_open_text("&model name = 'a', length = 'furlong' /\n&joint /\n", "wrong.nml", &model) == EK_DECK, "mistakes", model);
  require(model && strlen(ek_message(model)) > 0, "a message", model);
  ek_close(model);
}

int main(int argc, char **argv) {
  enum { room = 1000000 };
  double *values = malloc(room * sizeof *values);
  struct mallinfo2 start, end;
  long resident_start, n, k, heap;

  if (argc != 4 || !values) return 1;
  n = strtol(argv[3], NULL, 10);
  for (k = 0; k < n / 10; k++) cycle(argv[1], argv[2], values, room);
  start = mallinfo2();
  resident_start = resident();
  for (k = n / 10; k < n; k++) cycle(argv[1], argv[2], values, room);
  end = mallinfo2();
  heap = (long)end.uordblks - (long)start.uordblks + (long)end.hblkhd - (long)start.hblkhd;
  printf("%ld cycles: heap in use %+ld bytes, resident memory %+ld bytes after the first tenth\n", n, heap, resident() - resident_start);
  free(values);
  return heap < n - n / 10 ? 0 : 2;
}
