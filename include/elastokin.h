/* elastokin.h: the elastokinematics (kinematics and compliance) of a suspension, called from C.
 *
 * A handle (ek_model) contains one deck with its current numbers and its last solution:
 *
 *     ek_model *m;
 *     if (ek_open_file("axle.nml", &m) != EK_OK) puts(ek_message(m));      m exists also after an error
 *     ek_set(m, "bushing.lca_front.kt(1)", 500.0);                         path as in --set, unit of the deck
 *     if (ek_solve(m, "parallel_travel", 0, NULL) == EK_OK) ...
 *     ek_close(m);
 *
 * Every function that can fail returns an EK_ code, the exit status of the program `elastokin` for the same error.
 * ek_message then gives the message, with file, line and remedy. Nothing is printed, the process is never stopped, and
 * no state is shared. Each handle may be used by one thread at a time, and different handles by different threads.
 *
 * Counts and positions are int, and positions begin with 0. Strings are UTF-8 and end with '\0'. A returned string
 * belongs to the handle and stays valid until the handle has returned 16 further strings. The string of ek_message
 * stays valid until the next call. Parameters are in the units of the deck. Results are in the unit at the end of the
 * column name. Compliances are in SI units. Missing numbers are NaN. input/QUANTITIES.md defines signs and frames.
 *
 * Compatibility: the names, arguments and meanings of the functions and codes in this file do not change while the
 * SONAME is libelastokin.so.0. New functions may be added. Each new symbol has the version that introduced it. */
#ifndef ELASTOKIN_H
#define ELASTOKIN_H

#ifdef __cplusplus
extern "C" {
#endif

typedef struct ek_model ek_model;

enum {
  EK_OK = 0,
  EK_USAGE = 1,       /* an unknown name, path, case or column; a position outside the list; a value that is not a
                         finite number; in ek_set_text a value of the wrong type; a null pointer where this file does
                         not allow one */
  EK_DECK = 2,        /* errors of the deck, or numbers outside their legal ranges; the message lists all of them */
  EK_MODEL = 3,       /* a mechanism or redundant constraints; no case was solved */
  EK_CONVERGENCE = 4, /* some states did not converge. Their rows have converged = 0 and NaN. Key numbers that require
                         these states are NaN. The other rows and key numbers are valid */
  EK_FILE = 5         /* a file cannot be read, or memory does not suffice */
};

/* ---- the library ---- */
const char *ek_version(void);                       /* version of the library, as "0.1.0" */
/* If OpenBLAS provides LAPACK, sets OpenBLAS to one thread in this process. The matrices are too small to benefit from
 * several threads. Other users of OpenBLAS in this process are affected. */
int ek_use_one_thread(void);

/* ---- a model ---- */
int ek_open_file(const char *path, ek_model **model);                       /* reads a deck */
/* Reads a deck from a string. name is the file name in messages, and included files are relative to the folder of name.
 * NULL means "deck". */
int ek_open_text(const char *text, const char *name, ek_model **model);
void ek_close(ek_model *model);                     /* NULL is allowed */
const char *ek_message(ek_model *model);            /* message of the last call; "" if it succeeded */
const char *ek_name(ek_model *model);               /* name of the model */
const char *ek_checksum(ek_model *model);           /* checksum of the deck with its current numbers, 16 hex digits */
int ek_wheel_count(ek_model *model);                /* 0, 1 or 2; the left wheel comes first */

/* ---- copies ----
 * ek_copy copies the deck as it was opened and the changes made since, but not the solution. No file is read again.
 * *copy exists also after an error, as in ek_open_file. The list of files begins with the deck. It continues with all
 * files named in the deck: included files, hardpoints, property files and load tables. Their contents are those at the
 * time of opening. ek_open_files opens a deck from these contents, for instance in another process. */
int ek_copy(ek_model *model, ek_model **copy);
int ek_file_count(ek_model *model);
const char *ek_file_path(ek_model *model, int k);   /* path of the file when it was read; NULL outside the list */
const char *ek_file_text(ek_model *model, int k);   /* content of the file; NULL outside the list */
int ek_open_files(int n, const char *const *paths, const char *const *texts, ek_model **model);  /* the first: the deck */
/* Returns the deck with its current numbers as one string. A model opened from this string gives the same results. The
 * string contains the contents of included files, hardpoints and property files, both sides of a mirrored axle, and all
 * changes. Load tables are given by absolute paths. Returns NULL with a message if the numbers do not define a valid
 * model. */
const char *ek_deck_as_used(ek_model *model);

/* ---- remarks on the model ----
 * These are the remarks that the program prints before it solves a case. They report missing springs, contact points
 * that do not match the wheel, implausible values, connections and responses at design ("plausible? …"), and preloads
 * found by balance. If no case can be solved, they give the reason. ek_model_remarks examines the model with its
 * current numbers, solves no case, and sets count. The list does not change until the next ek_model_remarks. */
int ek_model_remarks(ek_model *model, int *count);
const char *ek_model_remark_text(ek_model *model, int k);
const char *ek_model_remark_severity(ek_model *model, int k);      /* "note", "warning" or "failure" */

/* ---- parameters: every number of the deck ----
 * A number outside its legal range (input/README.md) is rejected with EK_DECK, and no number is changed. ek_set_all
 * changes either all numbers or none. Legal numbers that together do not define a valid model (two points that
 * coincide, a case from 1 to 1) are stored; ek_solve and ek_numbers report them. ek_set_text reads the deck again and
 * rejects every error. */
int ek_parameter_count(ek_model *model);
const char *ek_parameter_path(ek_model *model, int k);       /* "bushing.lca_front.kt(1)"; NULL outside the range */
const char *ek_parameter_unit(ek_model *model, int k);       /* "N/mm"; "" if the number is dimensionless */
int ek_parameter_is_given(ek_model *model, int k);           /* 1: given in the deck; 0: default value */
int ek_parameter_twin(ek_model *model, int k);               /* mirrored axle: position of the corresponding number
                                                                of the left side; -1 if there is none */
int ek_get_at(ek_model *model, int k, double *value);
int ek_set_at(ek_model *model, int k, double value);
int ek_get_all(ek_model *model, int n, double *values);      /* n must be ek_parameter_count */
int ek_set_all(ek_model *model, int n, const double *values);
int ek_get(ek_model *model, const char *path, double *value);    /* NaN if the path stands for different numbers */
int ek_set(ek_model *model, const char *path, double value);     /* path as in --set; it may stand for both sides of a
                                                                   mirrored axle, and * for any letters */
int ek_set_text(ek_model *model, const char *path, const char *text);  /* "*1.1", "+2", or a string */
int ek_reset(ek_model *model);                      /* resets all numbers and strings to their values when opened */

/* ---- cases ----
 * The list begins with the cases of the deck. It continues with the standard tests that the deck does not define,
 * including the grid travel_and_steering if the deck has a &steering group. */
int ek_case_count(ek_model *model);
const char *ek_case_name(ek_model *model, int k);
int ek_case_is_of_deck(ek_model *model, int k);     /* 1: defined in the deck; 0: a standard test */

/* ---- solving ----
 * The results stay valid until the next ek_solve. They do not change when numbers are changed or reset, or when key
 * numbers are read. name NULL or "" selects the first case. n_columns 0 computes all columns. Otherwise the columns are
 * `state`, `factor`, the given columns in the order of the program's tables, and the columns on convergence. */
int ek_solve(ek_model *model, const char *name, int n_columns, const char *const *columns);
int ek_row_count(ek_model *model);                  /* states of the last solution; 0 if there is none */
int ek_column_count(ek_model *model);
const char *ek_column_name(ek_model *model, int k);          /* "left_toe_deg" */
const char *ek_column_unit(ek_model *model, int k);          /* "deg" */
const char *ek_column_title(ek_model *model, int k);         /* "Toe"; "" if it has no title */
const char *ek_column_sign(ek_model *model, int k);          /* "+ toe-in"; "" if it has no sign */
int ek_values(ek_model *model, int n, double *values);       /* n = rows x columns; row after row */
int ek_column_values(ek_model *model, const char *name, int n, double *values);   /* n = rows */
int ek_remark_count(ek_model *model);               /* notes, warnings and failures of the last solution */
const char *ek_remark_text(ek_model *model, int k);
const char *ek_remark_severity(ek_model *model, int k);      /* "note", "warning" or "failure" */

/* Compliance matrix at a state of the last solution, row after row; both dimensions are 6 x wheels. Rows are
 * displacements and rotations of each wheel centre (x y z [m], rx ry rz [rad]), columns the loads at the wheel centres
 * (fx fy fz [N], mx my mz [N m]). Both are in the frame of the deck. The vertical forces on all wheels are held.
 * Returns EK_USAGE if numbers were changed after the solution and ek_numbers was then called. */
int ek_compliance(ek_model *model, int row, int n, double *values);

/* Exact derivatives of columns in a row of the last solution with respect to numbers of the deck [unit of the column
 * per unit of the number]: n_columns x n_numbers, a row for each column. No solution is repeated. Derivatives include
 * the motion of the state, static equilibrium and balance. The case must have method equilibrium.
 *   columns: columns of the case (ek_solve need not have computed them), or entries of the compliance matrix (names as
 *            in the files of run --compliance)
 *   paths:   as in ek_set; each path stands for one number, or for this number on both sides of a mirrored axle
 *   errors:  estimates of the errors, or NULL
 * A derivative is NaN if the state did not converge, the column has no value at the state, or the number cannot be
 * changed. A further call with the same columns and paths is faster, even if numbers were changed. */
int ek_derivatives(ek_model *model, int row, int n_columns, const char *const *columns, int n_numbers, const char *const *paths,
                   double *values, double *errors);

/* ---- key numbers, as in key_numbers.csv of the report ----
 * ek_numbers computes the key numbers with the given names, and solves only the tests that these numbers require. In a
 * model of an axle, the name of a number of one wheel begins with left_ or right_; the name of an axle number does not.
 * The last solution (ek_values) is not changed. EK_CONVERGENCE: the numbers listed in the message are NaN. Either they
 * require a state that did not converge (states outside the window of a slope are not required), or the model does not
 * define them. The other numbers are valid. */
int ek_numbers(ek_model *model, int n, const char *const *names, double *values);
int ek_number_count(ek_model *model);               /* count of all names; solves no case; a number may be NaN */
const char *ek_number_name(ek_model *model, int k);
const char *ek_number_unit(ek_model *model, int k);
const char *ek_number_definition(ek_model *model, int k);

#ifdef __cplusplus
}
#endif
#endif
