/* elastokin.h: the elastokinematics (kinematics and compliance) of a suspension, called from C.
 *
 * A handle (ek_model) holds one deck with its present numbers and its last solution:
 *
 *     ek_model *m;
 *     if (ek_open_file("axle.nml", &m) != EK_OK) puts(ek_message(m));      m exists even after an error
 *     ek_set(m, "bushing.lca_front.kt(1)", 500.0);                         in the unit of the deck, as with --set
 *     if (ek_solve(m, "parallel_travel", 0, NULL) == EK_OK) ...
 *     ek_close(m);
 *
 * Every function that can fail returns an EK_ code, which is the exit status of the program `elastokin` for the same error.
 * ek_message then returns the message with file, line and remedy. The library does not print and does not stop the process. Handles
 * share no state: one thread at a time may use a handle, and different threads may use different handles.
 *
 * Counts and indices are int, and indices begin with 0. Strings are UTF-8 and end with '\0'. A returned string belongs to the handle.
 * It stays valid until this handle has returned 16 further strings (ek_message: until the next call). Parameters are in the units of
 * the deck, results in the unit at the end of the column name, and compliances in SI units. Missing numbers are NaN.
 * input/QUANTITIES.md gives signs and frames.
 *
 * Compatibility: names, arguments and meaning of the functions and codes of this file do not change while the SONAME is
 * libelastokin.so.0. New functions may be added. Their symbols have the version in which they were added. */
#ifndef ELASTOKIN_H
#define ELASTOKIN_H

#ifdef __cplusplus
extern "C" {
#endif

typedef struct ek_model ek_model;

enum {
  EK_OK = 0,
  EK_USAGE = 1,       /* an unknown name, path, case or column; an index outside the list; a value that is not a finite number;
                         in ek_set_text a value of the wrong type; a null pointer where this file does not allow a null pointer */
  EK_DECK = 2,        /* errors in the deck, or numbers outside their legal ranges; the message lists all */
  EK_MODEL = 3,       /* a mechanism, or redundant constraints; no case was solved */
  EK_CONVERGENCE = 4, /* some states did not converge. Their rows have converged = 0 and NaN, and key numbers that need these
                         states are NaN. All other rows and key numbers are valid */
  EK_FILE = 5         /* a file cannot be read, or there is not enough memory */
};

/* ---- the library ---- */
const char *ek_version(void);                       /* version of the library, for instance "0.1.0" */
int ek_use_one_thread(void);                          /* sets OpenBLAS to one thread in this process, if OpenBLAS is the LAPACK in use.
                                                       The matrices are small, and more threads would only wait. This also affects
                                                       other users of OpenBLAS in the process */

/* ---- a model ---- */
int ek_open_file(const char *path, ek_model **model);                       /* reads a deck */
int ek_open_text(const char *text, const char *name, ek_model **model);     /* name: name of the deck in messages; included files
                                                                               are relative to its folder. NULL: "deck" */
void ek_close(ek_model *model);                     /* NULL is allowed */
const char *ek_message(ek_model *model);            /* message of the last call; "" if the call succeeded */
const char *ek_name(ek_model *model);               /* name of the model */
const char *ek_checksum(ek_model *model);           /* checksum of the deck with its present numbers, 16 hexadecimal digits */
int ek_wheel_count(ek_model *model);                /* number of wheels: 0, 1 or 2; left before right */

/* ---- copies. A copy is made from the deck as it was opened, so that files are not read again. ek_copy applies the same changes to the
 * copy. The copy has no solution. *copy exists even after an error, as in ek_open_file. The files are the deck, then all files that the
 * deck names (included files, hardpoints, property files, load tables), with their content when the deck was opened. ek_open_files opens
 * a deck from these files, for instance in another process. ---- */
int ek_copy(ek_model *model, ek_model **copy);
int ek_file_count(ek_model *model);
const char *ek_file_path(ek_model *model, int k);   /* path with which the file was read; NULL outside the list */
const char *ek_file_text(ek_model *model, int k);
int ek_open_files(int n, const char *const *paths, const char *const *texts, ek_model **model);     /* the first file is the deck */
/* the deck with its present numbers as one string, which gives the same results. Included files, hardpoints, property files, both sides and
 * changes are written out. Load tables have absolute paths. NULL and a message if the numbers do not define a valid model */
const char *ek_deck_as_used(ek_model *model);

/* ---- remarks on the model, as the program prints them before it solves a case: a missing spring, contact points away from the point where
 * the wheel touches the ground, implausible values, connections and responses at design ("plausible? …"), preloads found by balance, or
 * the reason why no case can be solved. ek_model_remarks examines the model with its present numbers and returns the number of remarks. It
 * does not solve a case. The list is valid until the next call of ek_model_remarks ---- */
int ek_model_remarks(ek_model *model, int *count);
const char *ek_model_remark_text(ek_model *model, int k);
const char *ek_model_remark_severity(ek_model *model, int k);      /* "note", "warning" or "failure" */

/* ---- parameters: every number of the deck.
 * A number outside its legal range (input/README.md) is rejected with EK_DECK when it is set. Then no number is changed, also
 * with ek_set_all. Legal numbers that together do not define a valid model (two points that coincide, a case from 1 to 1) are stored;
 * ek_solve and ek_numbers report the error. ek_set_text reads the deck again and rejects every error. ---- */
int ek_parameter_count(ek_model *model);
const char *ek_parameter_path(ek_model *model, int k);       /* "bushing.lca_front.kt(1)"; NULL outside the range */
const char *ek_parameter_unit(ek_model *model, int k);       /* "N/mm"; "" without dimension */
int ek_parameter_is_given(ek_model *model, int k);           /* 1: the deck gives the number; 0: the number has its default */
int ek_parameter_twin(ek_model *model, int k);               /* on a mirrored axle: index of the same number on the
                                                                left side; -1: there is none */
int ek_get_at(ek_model *model, int k, double *value);
int ek_set_at(ek_model *model, int k, double value);
int ek_get_all(ek_model *model, int n, double *values);      /* n must be ek_parameter_count */
int ek_set_all(ek_model *model, int n, const double *values);
int ek_get(ek_model *model, const char *path, double *value);       /* NaN if the numbers of the path differ */
int ek_set(ek_model *model, const char *path, double value);        /* path as for --set: both sides of a mirrored axle,
                                                                       * for any characters */
int ek_set_text(ek_model *model, const char *path, const char *text);  /* text: "*1.1", "+2", or a string */
int ek_reset(ek_model *model);                      /* restores all numbers and strings of the deck as opened */

/* ---- cases: first the cases of the deck, then the standard tests that the deck does not contain (the grid travel_and_steering if the
 * deck has a &steering group) ---- */
int ek_case_count(ek_model *model);
const char *ek_case_name(ek_model *model, int k);
int ek_case_is_of_deck(ek_model *model, int k);

/* ---- solving; the results stay until the next solution, also if numbers or strings are changed or reset, or key numbers are read ---- */
int ek_solve(ek_model *model, const char *name, int n_columns, const char *const *columns);
                                                    /* name NULL or "": the first case. n_columns 0: all columns. Otherwise the results have
                                                       `state`, `factor`, the named columns in the order of the program's tables, and the
                                                       columns on convergence */
int ek_row_count(ek_model *model);                  /* number of states of the last solution; 0 without a solution */
int ek_column_count(ek_model *model);
const char *ek_column_name(ek_model *model, int k);          /* "left_toe_deg" */
const char *ek_column_unit(ek_model *model, int k);          /* "deg" */
const char *ek_column_title(ek_model *model, int k);         /* "Toe"; "" without a title */
const char *ek_column_sign(ek_model *model, int k);          /* "+ toe-in"; "" without a sign */
int ek_values(ek_model *model, int n, double *values);       /* n = rows x columns; row after row */
int ek_column_values(ek_model *model, const char *name, int n, double *values);   /* n = rows */
int ek_remark_count(ek_model *model);               /* notes, warnings and failures of the last solution */
const char *ek_remark_text(ek_model *model, int k);
const char *ek_remark_severity(ek_model *model, int k);      /* "note", "warning" or "failure" */

/* compliance matrix at a state of the last solution, row after row; n = (6 x wheels) squared. The rows are the displacements and rotations
 * of each wheel centre (x y z [m], rx ry rz [rad]). The columns are the loads at each wheel centre (fx fy fz [N], mx my mz [N m]), in the
 * frame of the deck. The vertical forces on all wheels are constant. EK_USAGE if numbers were changed after the solution and ek_numbers
 * was then called */
int ek_compliance(ek_model *model, int row, int n, double *values);

/* exact derivatives of columns in a row of the last solution with respect to numbers of the deck [unit of the column per unit of the
 * number]: n_columns x n_numbers values, one row per column. No state is solved again. The motion of the state, the static equilibrium
 * under constant loads and the preload trim are included. columns: columns of the case, also those not requested in ek_solve, or entries
 * of the compliance matrix (as in the files of run --compliance). paths: as in ek_set, each for one number, or for both sides of a
 * mirrored axle. errors: estimates of the errors, or NULL. A value is NaN if the state did not converge, if the column has no value at
 * the state, or if the number cannot change. Requires method equilibrium. A further call with the same columns and paths, for another
 * design, is faster than the first call */
int ek_derivatives(ek_model *model, int row, int n_columns, const char *const *columns, int n_numbers, const char *const *paths,
                   double *values, double *errors);

/* ---- key numbers, as in key_numbers.csv of the report ---- */
/* returns the key numbers with these names; only the tests that these numbers need are solved. On an axle a name begins with left_ or
 * right_, unless the number belongs to the whole axle. The last solution (ek_values) is not changed. EK_CONVERGENCE: some numbers are NaN,
 * because a state that they need did not converge or because the model does not define them. States outside the window of a slope are not
 * needed. The message lists the numbers without a value. All other numbers are valid. */
int ek_numbers(ek_model *model, int n, const char *const *names, double *values);
int ek_number_count(ek_model *model);               /* number of all names. Does not solve, so that a name may have no value */
const char *ek_number_name(ek_model *model, int k);
const char *ek_number_unit(ek_model *model, int k);
const char *ek_number_definition(ek_model *model, int k);

#ifdef __cplusplus
}
#endif
#endif
