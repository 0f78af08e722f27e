/* elastokin.h: the elastokinematics (kinematics and compliance) of a suspension, called from C.
 *
 * A handle (ek_model) contains one deck with its current numbers and its last solution:
 *
 *     ek_model *m;
 *     if (ek_open_file("axle.nml", &m) != EK_OK) puts(ek_message(m));      after an error, m contains the message
 *     ek_set(m, "bushing.lca_front.kt(1)", 500.0);                         path as in --set, value in the deck's unit
 *     if (ek_solve(m, "parallel_travel", 0, NULL) == EK_OK) ...
 *     ek_close(m);                                                         required after an error, too
 *
 * A function whose result is an error code returns one of the EK_ codes below. The program `elastokin` has the same
 * codes as exit status. If a function whose result is a string fails, it returns NULL. ek_message never returns NULL;
 * it gives the message of the failed call. For an error in a deck, the message gives the file and, if the error
 * belongs to a line, the line. For an error in a changed number, the message gives the path of the number.
 * (ek_use_one_thread has no handle, and therefore no message.) The library prints nothing, never stops the process,
 * and shares no state between handles. One thread at a time may use a handle. Different threads may use different
 * handles at the same time.
 *
 * Counts and positions are of type int. Positions are counted from 0. Strings are UTF-8 and end with '\0'. A returned
 * string belongs to the handle and stays valid until the handle has returned 16 further strings. The string returned
 * by ek_message stays valid until the next call with this handle. Parameters are in the units of the deck.
 * ek_column_unit gives the unit of a result column, ek_number_unit the unit of a K&C metric. The values of
 * ek_compliance are in SI units. A result without a value is NaN. input/QUANTITIES.md defines signs and frames.
 *
 * Compatibility: the names, arguments and meanings of the functions and codes in this file do not change while the
 * SONAME is libelastokin.so.0. New functions may be added; an added function has a new symbol version. */
#ifndef ELASTOKIN_H
#define ELASTOKIN_H

#ifdef __cplusplus
extern "C" {
#endif

typedef struct ek_model ek_model;

enum {
  EK_OK = 0,
  EK_USAGE = 1,       /* an unknown name, path, case or column; a position outside the list; an array of the wrong
                         length; a value that is not a finite number; in ek_set_text, a value of the wrong type; a
                         missing solution; a case that the function does not support; a null pointer where this file
                         does not allow a null pointer */
  EK_DECK = 2,        /* errors in the deck, or numbers outside their legal ranges; the message lists all errors */
  EK_MODEL = 3,       /* the model cannot be solved: it has a mechanism or redundant constraints, or preload trim
                         (`balance`) has no solution */
  EK_CONVERGENCE = 4, /* some states did not converge, the model does not define a requested K&C metric, or preload trim
                         (`balance`) did not converge. If preload trim did not converge, there are no results.
                         ek_solve computes the states from design towards each end of the range. In each direction, the
                         table ends with the first state that is not reached. In its row, `converged` is 0 and the
                         results are NaN. If the states are those of a load table or of the grid travel_and_steering,
                         the result table contains a row for every state.
                         With method recursive or corrected, `converged` is also 0 for a state that violates the joint
                         constraints; its results are finite.
                         K&C metrics that require a state with `converged` = 0 are NaN. The other rows and K&C metrics
                         are valid */
  EK_FILE = 5         /* the deck or a load table cannot be read (an included, hardpoint or property file: EK_DECK), or
                         there is not enough memory */
};

/* ---- the library ---- */
const char *ek_version(void);                       /* version of the library, for example "0.1.0" */
/* If OpenBLAS provides LAPACK, sets OpenBLAS to one thread in this process. The matrices are too small to benefit from
 * several threads. The setting also applies to all other users of OpenBLAS in this process. */
int ek_use_one_thread(void);

/* ---- a model ---- */
int ek_open_file(const char *path, ek_model **model);                       /* reads a deck from a file */
/* Reads a deck from a string. name is the file name in messages. Relative paths of the files that are named in the
 * deck start from the folder of name. If name is NULL, the name is "deck". */
int ek_open_text(const char *text, const char *name, ek_model **model);
void ek_close(ek_model *model);                     /* frees the handle; NULL is allowed */
const char *ek_message(ek_model *model);            /* message of the last call; "" if that call succeeded */
const char *ek_name(ek_model *model);               /* name of the model */
const char *ek_checksum(ek_model *model);           /* checksum of the deck with its current numbers, 16 hex digits */
int ek_wheel_count(ek_model *model);                /* 0, 1 or 2; the left wheel is first in all results */

/* ---- copies ----
 * ek_copy opens a new handle, and copies the deck as it was opened and all changes made since then. ek_copy does not
 * copy the solution, and does not read files. If model contains no deck, ek_copy returns an error code and leaves
 * *copy unchanged. After any other error, ek_message(*copy) gives the message, and *copy must be closed.
 *
 * A handle contains a list of files. The first file of the list is the deck. The other files are named in the deck:
 * included files, hardpoints, property files and load tables. ek_file_path returns the path of file k, and
 * ek_file_text the content that the file had when the deck was opened. ek_open_files opens a deck from such contents,
 * for instance in another process. A file that is named in the deck but not given in paths is read from disk. */
int ek_copy(ek_model *model, ek_model **copy);
int ek_file_count(ek_model *model);
const char *ek_file_path(ek_model *model, int k);   /* path of the file; NULL outside the list */
const char *ek_file_text(ek_model *model, int k);   /* content of the file; NULL outside the list */
int ek_open_files(int n, const char *const *paths, const char *const *texts, ek_model **model);  /* the deck is first */
/* Returns the deck with its current numbers as one string. A model opened from this string gives the same results as
 * the original model. The string contains all changes, both sides of a mirrored axle, and the contents of included
 * files, hardpoints and property files. Load tables are not contained; the string gives the absolute path of each load
 * table. If the numbers do not define a valid model, the function returns NULL, and ek_message gives the message. */
const char *ek_deck_as_used(ek_model *model);

/* ---- messages on the model ----
 * ek_model_remarks examines the model with its current numbers, and sets count to the number of messages found. No
 * case is solved. The program prints the same messages before it solves a case:
 *   failure: the reason why no case can be solved
 *   note:    a spring preload found by preload trim (`balance`)
 *   warning: a missing spring; a contact point that does not match the wheel; a driver that preload trim excludes;
 *            preloads that are not unique. A warning that begins with "plausible?" reports an implausible value,
 *            connection, or response at design
 * The list of messages does not change until the next call of ek_model_remarks. */
int ek_model_remarks(ek_model *model, int *count);
const char *ek_model_remark_text(ek_model *model, int k);
const char *ek_model_remark_severity(ek_model *model, int k);      /* "note", "warning" or "failure" */

/* ---- parameters: every real parameter of the deck ----
 * Integers, for example `increments` of a case, are not in this list. ek_set and ek_set_text set integers; ek_get does
 * not read integers.
 *
 * If a number is outside its legal range (input/README.md), a function that sets numbers returns EK_DECK and changes
 * no number. ek_set_all sets either all numbers or none. Legal numbers are stored even if they do not define a valid
 * model together (two points that coincide, a case whose range is from 1 to 1). The next ek_solve or ek_numbers then
 * returns the error. ek_set_text checks the whole deck with the new value, and rejects a value that causes an error.
 * For this check, the files of the deck are not read again; only a file with a new path is read. */
int ek_parameter_count(ek_model *model);
const char *ek_parameter_path(ek_model *model, int k);       /* "bushing.lca_front.kt(1)"; NULL outside the list */
const char *ek_parameter_unit(ek_model *model, int k);       /* "N/mm"; "" if the number is dimensionless */
int ek_parameter_is_given(ek_model *model, int k);           /* 1: given in the deck; 0: default value */
int ek_parameter_twin(ek_model *model, int k);               /* for a number of the right side of a mirrored axle:
                                                                position of the corresponding number of the left side;
                                                                else -1 */
int ek_get_at(ek_model *model, int k, double *value);
int ek_set_at(ek_model *model, int k, double value);
int ek_get_all(ek_model *model, int n, double *values);      /* n must be ek_parameter_count */
int ek_set_all(ek_model *model, int n, const double *values);
int ek_get(ek_model *model, const char *path, double *value);    /* NaN if the path leads to several
                                                                    numbers with different values */
/* Sets all numbers to which a path leads; path as in --set. On a mirrored axle, a path without left_ or right_ leads
 * to the numbers of both sides. In a name, * matches any sequence of characters, also an empty sequence. */
int ek_set(ek_model *model, const char *path, double value);
/* Sets a number or a string. text is the new value as in --set: "1.5", "*1.1" (multiplies a number by 1.1), "+2" (adds
 * 2 to a number, in the unit of the deck), or a string. */
int ek_set_text(ek_model *model, const char *path, const char *text);
int ek_reset(ek_model *model);                      /* resets all numbers and strings to the deck as opened */

/* ---- cases ----
 * The list begins with the cases of the deck. Then follow the standard tests that the deck does not define. If the
 * deck has a &steering group, the standard tests include the grid travel_and_steering. */
int ek_case_count(ek_model *model);
const char *ek_case_name(ek_model *model, int k);
int ek_case_is_of_deck(ek_model *model, int k);     /* 1: defined in the deck; 0: standard test */

/* ---- solving ----
 * ek_solve solves one case. If name is NULL or "", ek_solve solves the first case of the list. The results stay valid
 * until the next ek_solve: setting or resetting numbers and computing K&C metrics do not change the results. If
 * n_columns is 0, the result table contains all columns. Otherwise the table contains `state`, `factor`, the requested
 * columns in the order of the program's tables, and the columns on convergence (`converged` and those after
 * `converged`). In a requested name, * matches any sequence of characters, also an empty sequence. */
int ek_solve(ek_model *model, const char *name, int n_columns, const char *const *columns);
/* Converts the table of the last solution to the definitions of another program: names, units, signs and values of its
 * columns. program is a value of --definitions: "adams", "motionview", "ipg", "optimumk", "lotus", "mathworks" or "sae";
 * NULL or "" gives the columns of elastokin again. ek_column_count to ek_column_values then describe the converted
 * table; its rows are those of the solution. Only columns whose formula has all of its columns in the solution exist: ask
 * ek_solve for all columns. The next ek_solve gives the columns of elastokin. */
int ek_define(ek_model *model, const char *program);
int ek_row_count(ek_model *model);                  /* rows (states) of the last solution; 0 without a solution */
int ek_column_count(ek_model *model);
const char *ek_column_name(ek_model *model, int k);          /* "left_toe_deg" */
const char *ek_column_unit(ek_model *model, int k);          /* "deg" */
const char *ek_column_title(ek_model *model, int k);         /* "Toe"; "" if the column has no title */
const char *ek_column_sign(ek_model *model, int k);          /* "+ front edge inward"; "" without a sign */
int ek_values(ek_model *model, int n, double *values);       /* n must be rows x columns; order: row after row */
int ek_column_values(ek_model *model, const char *name, int n, double *values);   /* n must be ek_row_count */
int ek_remark_count(ek_model *model);               /* count of messages on the last solution */
const char *ek_remark_text(ek_model *model, int k);
const char *ek_remark_severity(ek_model *model, int k);      /* "note", "warning" or "failure" */

/* Compliance matrix at one state of the last solution. row is the position of the state in the result table. n must be
 * (6 x ek_wheel_count) squared, and values contains one row of the matrix after the other. Each row of the matrix is a
 * displacement or rotation of a wheel centre (x y z [m], rx ry rz [rad]). Each column of the matrix is a load at a
 * wheel centre (fx fy fz [N], mx my mz [N m]). Displacements and loads are in the frame of the deck. The vertical
 * forces of the ground on the wheels stay constant (`load_held` in input/QUANTITIES.md). All entries are NaN if the
 * state was not reached or the matrix is singular.
 *
 * ek_compliance, ek_poses and ek_derivatives return EK_USAGE if numbers were changed after the solution and ek_numbers
 * or ek_model_remarks was called after the change. Call ek_solve again before these functions. */
int ek_compliance(ek_model *model, int row, int n, double *values);

/* Motion of all bodies from design to one state of the last solution. row is the position of the state in the result
 * table. The bodies are those of the model without the chassis; in a mirrored deck, both sides are listed. values
 * contains 12 numbers for each body, and n must be 12 x ek_body_count: the rotation R, one row of the matrix after the
 * other, then the shift t [m]. In the axes of the deck, a point of the body that is at p at design [m] is at R p + t in
 * the state. All values are NaN if the state was not reached. */
int ek_body_count(ek_model *model);
const char *ek_body_name(ek_model *model, int k);   /* NULL outside the list */
int ek_poses(ek_model *model, int row, int n, double *values);

/* Computes derivatives of columns with respect to parameters of the deck, at one state of the last solution. The unit is
 * the unit of the column per unit of the number. The derivatives are accurate to about 1e-7 of the largest derivative of
 * the column, and errors gives the estimated error of each. row is the position of the state in the result table.
 * values contains the n_numbers derivatives of the first column, then the n_numbers derivatives of the second column,
 * and so on. The case is not solved again. The derivatives account for the change of the state, of the static
 * equilibrium and of the trimmed preloads (`balance`). For a case with follow = 'arc', or with a method other than
 * equilibrium, ek_derivatives returns EK_USAGE.
 *   columns: columns of the case, also columns not requested in ek_solve; or entries of the compliance matrix, with the
 *            names in the files of run --compliance; after ek_define also columns of the program, with the names of
 *            ek_column_name
 *   paths:   as in ek_set; each path must lead to one number, or to the corresponding numbers on both sides of a
 *            mirrored axle
 *   errors:  estimated errors of the derivatives, in the order of values; may be NULL
 * A derivative is NaN if the state did not converge, if the matrix of the state is singular, or if the column has no
 * value at the state. It is also NaN if neighbouring values of the number do not define a valid model. A further call
 * with the same case, columns and paths is faster, even if numbers were changed. */
int ek_derivatives(ek_model *model, int row, int n_columns, const char *const *columns, int n_numbers,
                   const char *const *paths, double *values, double *errors);

/* ---- K&C metrics, as in key_numbers.csv of the report ----
 * ek_numbers computes the K&C metrics with the given names, and solves only the tests that these K&C metrics require.
 * The last solution (ek_values) does not change. In a model with two wheels, the name of a K&C metric of one wheel
 * begins with left_ or right_. The name of a K&C metric of the whole axle has no such prefix.
 *
 * If ek_numbers returns EK_CONVERGENCE, the K&C metrics listed in the message are NaN, and the K&C metrics not listed
 * are valid. The message gives the reason for each: a required state has `converged` = 0, or the model does not define
 * the K&C metric. A K&C metric that is a slope requires only the states inside the window of the slope
 * (input/QUANTITIES.md). If preload trim (`balance`) did not converge, the message lists no K&C metrics, and all
 * values are NaN. */
int ek_numbers(ek_model *model, int n, const char *const *names, double *values);
int ek_number_count(ek_model *model);               /* count of all names. No case is solved; a listed K&C
                                                       metric may be NaN */
const char *ek_number_name(ek_model *model, int k);
const char *ek_number_unit(ek_model *model, int k);
const char *ek_number_definition(ek_model *model, int k);

#ifdef __cplusplus
}
#endif
#endif
