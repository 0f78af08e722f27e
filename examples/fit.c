/* fit DECK: fits a bushing rate to a target compliance (as fit.py and fit.f90).
 * cc -o fit fit.c -I PREFIX/include -L PREFIX/lib -lelastokin -Wl,-rpath,PREFIX/lib -lm */
#include <elastokin.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const char *path = "bushing.lca_front.kt(2)"; /* [N/mm] */
static const char *number = "left_braking_deflection"; /* [mm/kN] */
static const double target = 6.0;
static ek_model *model;

static void check(int code) {
  if (code == EK_OK) return;
  fprintf(stderr, "%s\n", ek_message(model));
  ek_close(model);
  exit(code);
}

static double miss(double rate) {
  double value;
  check(ek_set(model, path, rate));
  check(ek_numbers(model, 1, &number, &value));
  return value - target;
}

int main(int argc, char **argv) {
  double before, rate, miss_before, miss_now, slope;
  int step;

  if (argc != 2) return EK_USAGE;
  check(ek_open_file(argv[1], &model));
  check(ek_get(model, path, &before));
  rate = 0.9 * before;
  miss_before = miss(before);
  miss_now = miss(rate);
  for (step = 1; step <= 20; step++) {
    printf("%2d %.16e %.16e\n", step, rate, miss_now);
    if (fabs(miss_now) < 1e-9) break;
    slope = (miss_now - miss_before) / (rate - before);
    before = rate;
    miss_before = miss_now;
    rate = rate - miss_now / slope;
    miss_now = miss(rate);
  }
  ek_close(model);
  if (step > 20) fprintf(stderr, "fit: no rate found in 20 steps\n");
  return step > 20 ? EK_CONVERGENCE : EK_OK;
}
