/* loop DECK PATH CASE N: changes a parameter of a deck and solves the case, N times, and prints the time of a design [µs]: with all
 * columns, and of the K&C metrics NUMBER... that may follow. */
#define _POSIX_C_SOURCE 200809L
#include <elastokin.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

static ek_model *model;

static void check(int code) {
  if (code == EK_OK) return;
  fprintf(stderr, "loop: %s\n", ek_message(model));
  exit(code);
}

static double seconds(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

int main(int argc, char **argv) {
  double start, base, *values;
  int k, n, size;

  if (argc < 5) return EK_USAGE;
  n = atoi(argv[4]);
  check(ek_open_file(argv[1], &model));
  check(ek_get(model, argv[2], &base));
  check(ek_solve(model, argv[3], 0, NULL));
  size = ek_row_count(model) * ek_column_count(model);
  values = malloc((size_t)(size > argc ? size : argc) * sizeof *values);
  if (!values) return EK_FILE;

  start = seconds();
  for (k = 0; k < n; k++) {
    check(ek_set(model, argv[2], base * (1 + 1e-4 * k)));
    check(ek_solve(model, argv[3], 0, NULL));
    check(ek_values(model, size, values));
  }
  printf("%.1f", 1e6 * (seconds() - start) / n);
  if (argc > 5) {
    start = seconds();
    for (k = 0; k < n; k++) {
      check(ek_set(model, argv[2], base * (1 + 1e-4 * k)));
      check(ek_numbers(model, argc - 5, (const char *const *)&argv[5], values));
    }
    printf(" %.1f", 1e6 * (seconds() - start) / n);
  }
  printf("\n");
  free(values);
  ek_close(model);
  return EK_OK;
}
