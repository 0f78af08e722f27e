/* elastokin.h: the elastokinematics (kinematics and compliance) of a suspension, called from C.
 *
 * A handle (ek_model) contains one deck with its current numbers and its last solution:
 *
 *     ek_model *m;
 *     if (ek_open_file("axle.nml", &m) != EK_OK) puts(ek_message(m));      after an error, m gives the message
 *     ek_set(m, "bushing.lca_front.kt(1)", 500.0);                         path as in --set, value in the deck's unit
 *     if (ek_solve(m, "parallel_travel", 0, NULL) == EK_OK) ...
 *     ek_close(m);                                                         also after an error
 *
 * A function that can fail returns an EK_ code (the exit status of the program `elastokin` for the same error), or NULL
 * if it returns a string. ek_message then gives the message, with file, line and remedy. The library prints nothing,
 * never stops the process, and shares no state between handles. One thread at a time may use a handle. Different
 * threads may use different handles at the same time.
 *
 * Counts and positions are int, and positions begin with 0. Strings are UTF-8 and end with '\0'. A returned string
 * belongs to the handle and stays valid until the handle has returned 16 further strings. The string of ek_message
 * stays valid until the next call with this handle. Parameters are in the units of the deck. Results are in the unit at
 * the end of the column name. The compliance matrix of ek_compliance is in SI units. Missing numbers are NaN.
 * input/QUANTITIES.md defines signs and frames.
 *
 * Compatibility: the names, arguments and meanings of the functions and codes in this file do not change while the
 * SONAME is libelastokin.so.0. New functions may be added. The symbol version of an added function is the release that
 * introduced this function. */
#ifndef ELASTOKIN_H
#define ELASTOKIN_H

#ifdef __cplusplus
extern "C" {
#endif

typedef struct ek_model ek_model;

enum {
  EK_OK = 0,
  EK_USAGE = 1,       /* an unknown name, path, case or column; a position outside the list; an array of the wrong
                         length; a value that is not a finite number; in ek_set_text, a value of the wrong type; a null
                         pointer where this file does not allow one */
  EK_DECK = 2,        /* errors of the deck, or numbers outside their legal ranges; the message lists all errors */
  EK_MODEL = 3,       /* the model has a mechanism or redundant constraints; no case was solved */
  EK_CONVERGENCE = 4, /* some states did not converge. The table ends on each side with the first of these states. In
                         the row of this state, converged is 0 and the results are NaN. If a load table defines the
                         case, the table has a row for every state. Key numbers that require a state that did not
                         converge are NaN. The other rows and key numbers are valid */
  EK_FILE = 5         /* a file cannot be read, or memory does not suffice */
};

/* ---- the library ---- */
const char *ek_version(void);                       /* version of the library, for example "0.1.0" */
/* If OpenBLAS provides LAPACK, sets OpenBLAS to one thread in this process. The matrices are too small to benefit from
 * several threads. Other users of OpenBLAS in this process are affected. */
int ek_use_one_thread(void);

/* ---- a model ---- */
int ek_open_file(const char *path, ek_model **model);                       /* reads a deck from a file */
/* Reads a deck from a string. name is the file name in messages. Paths of included files are relative to the folder of
 * name. If name is NULL, the name "deck" is used. */
int ek_open_text(const char *text, const char *name, ek_model **model);
void ek_close(ek_model *model);                     /* frees the handle; NULL is allowed */
const char *ek_message(ek_model *model);            /* message of the last call; "" if this call succeeded */
const char *ek_name(ek_model *model);               /* name of the model */
const char *ek_checksum(ek_model *model);           /* checksum of the deck with its current numbers, 16 hex digits */
int ek_wheel_count(ek_model *model);                /* 0, 1 or 2; in all results the left wheel comes first */

/* ---- copies ----
 * ek_copy copies the deck as it was opened, and all changes made since then. ek_copy does not copy the solution, and
 * reads no file again. After an error, ek_message(*copy) gives the message, and *copy must be closed.
 *
 * ek_file_path and ek_file_text read the list of files. The deck is the first file of the list. All files named in the
 * deck follow: included files, hardpoints, property files and load tables. ek_file_text gives the content of a file at
 * the time of opening. ek_open_files opens a deck from these contents, for instance in another process. */
int ek_copy(ek_model *model, ek_model **copy);
int ek_file_count(ek_model *model);
const char *ek_file_path(ek_model *model, int k);   /* path from which the file was read; NULL outside the list */
const char *ek_file_text(ek_model *model, int k);   /* content of the file; NULL outside the list */
int ek_open_files(int n, const char *const *paths, const char *const *texts, ek_model **model);  /* file 0: the deck */
/* Returns the deck with its current numbers as one string. A model opened from this string gives the same results. The
 * string contains the contents of included files, hardpoints and property files, both sides of a mirrored axle, and all
 * changes. The string gives the absolute path of each load table. If the numbers do not define a valid model, the
 * function returns NULL, and ek_message gives the message. */
const char *ek_deck_as_used(ek_model *model);

/* ---- remarks on the model ----
 * These are the messages (notes, warnings, failures) about the model that the program prints before it solves a case.
 * These messages report missing springs, contact points that do not match the wheel, and preloads found by preload trim
 * (`balance`). Messages that begin with "plausible?" report implausible values, connections and responses at design. If
 * no case can be solved, a failure gives the reason. ek_model_remarks examines the model with its current numbers,
 * solves no case, and sets count to the number of messages. The list of messages does not change until the next call of
 * ek_model_remarks. */
int ek_model_remarks(ek_model *model, int *count);
const char *ek_model_remark_text(ek_model *model, int k);
const char *ek_model_remark_severity(ek_model *model, int k);      /* "note", "warning" or "failure" */

/* ---- parameters: every number of the deck ----
 * A number outside its legal range (input/README.md) is rejected with EK_DECK, and no number is changed. ek_set_all
 * changes either all numbers or none. Legal numbers that together do not define a valid model (two points that
 * coincide, a case whose range is from 1 to 1) are stored. ek_solve and ek_numbers then report the error. ek_set_text
 * checks the whole deck with the new value, without reading a file, and rejects any value that causes an error. */
int ek_parameter_count(ek_model *model);
const char *ek_parameter_path(ek_model *model, int k);       /* "bushing.lca_front.kt(1)"; NULL outside the range */
const char *ek_parameter_unit(ek_model *model, int k);       /* "N/mm"; "" if the number is dimensionless */
int ek_parameter_is_given(ek_model *model, int k);           /* 1: given in the deck; 0: default value */
int ek_parameter_twin(ek_model *model, int k);               /* mirrored axle: position of the corresponding number
                                                                of the left side; -1 without such a number */
int ek_get_at(ek_model *model, int k, double *value);
int ek_set_at(ek_model *model, int k, double value);
int ek_get_all(ek_model *model, int n, double *values);      /* n must be ek_parameter_count */
int ek_set_all(ek_model *model, int n, const double *values);
int ek_get(ek_model *model, const char *path, double *value);    /* NaN if the path stands for several
                                                                    numbers with different values */
int ek_set(ek_model *model, const char *path, double value);     /* path as in --set: a path may stand for both sides of
                                                                   a mirrored axle; * stands for any letters */
/* text: "*1.1" multiplies, "+2" adds; or a number, or the value of a key that is a string */
int ek_set_text(ek_model *model, const char *path, const char *text);
int ek_reset(ek_model *model);                      /* restores all numbers and strings of the deck as opened */

/* ---- cases ----
 * The list contains the cases of the deck, followed by the standard tests that the deck does not define. The grid
 * travel_and_steering is one of these tests if the deck has a &steering group. */
int ek_case_count(ek_model *model);
const char *ek_case_name(ek_model *model, int k);
int ek_case_is_of_deck(ek_model *model, int k);     /* 1: defined in the deck; 0: standard test */

/* ---- solving ----
 * The results stay valid until the next ek_solve. The results do not change when numbers are changed or reset, or when
 * key numbers are computed. If name is NULL or "", the first case is solved. If n_columns is 0, the table has all
 * columns. Otherwise the table has `state`, `factor`, the given columns in the order of the program's tables, and the
 * columns on convergence. In the name of a given column, * stands for any letters. */
int ek_solve(ek_model *model, const char *name, int n_columns, const char *const *columns);
int ek_row_count(ek_model *model);                  /* count of rows (states) of the last solution; 0 without a solution */
int ek_column_count(ek_model *model);
const char *ek_column_name(ek_model *model, int k);          /* "left_toe_deg" */
const char *ek_column_unit(ek_model *model, int k);          /* "deg" */
const char *ek_column_title(ek_model *model, int k);         /* "Toe"; "" if the column has no title */
const char *ek_column_sign(ek_model *model, int k);          /* "+ front edge inward"; "" without a sign */
int ek_values(ek_model *model, int n, double *values);       /* n must be rows x columns; row after row */
int ek_column_values(ek_model *model, const char *name, int n, double *values);   /* n must be rows */
int ek_remark_count(ek_model *model);               /* count of messages about the last solution */
const char *ek_remark_text(ek_model *model, int k);
const char *ek_remark_severity(ek_model *model, int k);      /* "note", "warning" or "failure" */

/* Compliance matrix at one state (row) of the last solution, row after row; both dimensions are 6 x wheels. A row of
 * the matrix belongs to a displacement or rotation of a wheel centre (x y z [m], rx ry rz [rad]). A column belongs to a
 * load at a wheel centre (fx fy fz [N], mx my mz [N m]). Displacements and loads are in the frame of the deck. The
 * vertical forces on all wheels are held. All entries are NaN if the state did not converge. If numbers were changed
 * after the solution and ek_numbers was then called, ek_compliance and ek_derivatives return EK_USAGE. */
int ek_compliance(ek_model *model, int row, int n, double *values);

/* Exact derivatives of columns with respect to numbers of the deck, at one state (row) of the last solution [unit of
 * the column per unit of the number]. values contains the n_numbers derivatives of the first column, then those of the
 * next column. No solution is repeated. Derivatives account for the change of the state, of the static equilibrium and
 * of the trimmed preloads (`balance`). The case must have method equilibrium.
 *   columns: columns of the case (ek_solve need not have computed them), or entries of the compliance matrix (names as
 *            in the files of run --compliance)
 *   paths:   as in ek_set; each path stands for one number, or for this number on both sides of a mirrored axle
 *   errors:  estimated errors of the derivatives, in the order of values; may be NULL
 * A derivative is NaN if the state did not converge, the column has no value at the state, or the number cannot be
 * changed. A further call with the same columns and paths is faster, even if numbers were changed. */
int ek_derivatives(ek_model *model, int row, int n_columns, const char *const *columns, int n_numbers, const char *const *paths,
                   double *values, double *errors);

/* ---- key numbers, as in key_numbers.csv of the report ----
 * ek_numbers computes the key numbers with the given names, and solves only the tests that these numbers require. In a
 * model of an axle, the name of a number of one wheel begins with left_ or right_. The name of a number of the axle
 * does not. The last solution (ek_values) does not change.
 *
 * If ek_numbers returns EK_CONVERGENCE, the numbers listed in the message are NaN. Either such a number requires a
 * state that did not converge (a slope does not require states outside its window), or the model does not define this
 * number. The other numbers are valid. */
int ek_numbers(ek_model *model, int n, const char *const *names, double *values);
int ek_number_count(ek_model *model);               /* count of all names; no case is solved; listed numbers may be NaN */
const char *ek_number_name(ek_model *model, int k);
const char *ek_number_unit(ek_model *model, int k);
const char *ek_number_definition(ek_model *model, int k);

#ifdef __cplusplus
}
#endif
#endif
