/* callers DECK PATH VALUE CASE: changes a number, solves a case and prints column names and values with 17 digits. Then two threads
 * solve 20 times each, each with its own model and number; every value must be the same to the bit. */
#include <elastokin.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
  const char *deck, *path, *name;
  double value;
  int rows, columns;
  double *values;
} job_t;

static void require(int holds, const char *what, ek_model *model) {
  if (holds) return;
  fprintf(stderr, "callers: %s: %s\n", what, model ? ek_message(model) : "");
  exit(1);
}

/* solves the job once; is_printed: prints the table */
static void solve(job_t *job, int is_printed) {
  ek_model *model;
  int i, k, n;

  require(ek_open_file(job->deck, &model) == EK_OK, "open", model);
  require(ek_set(model, job->path, job->value) == EK_OK, "set", model);
  require(ek_solve(model, job->name, 0, NULL) == EK_OK, "solve", model);
  job->rows = ek_row_count(model);
  job->columns = ek_column_count(model);
  n = job->rows * job->columns;
  job->values = realloc(job->values, (size_t)n * sizeof *job->values);
  require(job->values && ek_values(model, n, job->values) == EK_OK, "values", model);
  for (k = 0; is_printed && k < job->columns; k++) printf("%s%c", ek_column_name(model, k), k + 1 < job->columns ? ',' : '\n');
  for (i = 0; is_printed && i < n; i++) printf("%.17g%c", job->values[i], (i + 1) % job->columns ? ',' : '\n');
  ek_close(model);
}

static void *work(void *argument) {
  job_t *wanted = argument, again;
  int round;

  again = *wanted;
  again.values = NULL;
  for (round = 0; round < 20; round++) {
    solve(&again, 0);
    require(again.rows == wanted->rows && again.columns == wanted->columns, "another table in a thread", NULL);
    require(!memcmp(again.values, wanted->values, (size_t)again.rows * (size_t)again.columns * sizeof(double)),
            "other values in a thread", NULL);
  }
  free(again.values);
  return NULL;
}

int main(int argc, char **argv) {
  job_t jobs[2];
  pthread_t threads[2];
  int k;

  if (argc != 5) return 1;
  for (k = 0; k < 2; k++) {
    memset(&jobs[k], 0, sizeof jobs[k]);
    jobs[k].deck = argv[1];
    jobs[k].path = argv[2];
    jobs[k].value = strtod(argv[3], NULL) * (1 + 0.1 * k);
    jobs[k].name = argv[4];
    solve(&jobs[k], k == 0);
  }
  for (k = 0; k < 2; k++) require(!pthread_create(&threads[k], NULL, work, &jobs[k]), "a thread", NULL);
  for (k = 0; k < 2; k++) pthread_join(threads[k], NULL);
  for (k = 0; k < 2; k++) free(jobs[k].values);
  fprintf(stderr, "callers: 2 threads agree\n");
  return 0;
}
