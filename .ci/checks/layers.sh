# shellcheck shell=bash disable=SC2154
# Checks of the layers.

# A file, a module of a layer above it that it must not use, the library of the file
upward_uses() {
  cat <<'END'
base/ek_kinds.f90 ek_path ek_base
base/ek_kinds.f90 ek_rotation ek_base
math/ek_rotation.f90 ek_measure ek_math
model/ek_case.f90 ek_deck ek_model
model/ek_case.f90 ek_path ek_model
equilibrium/ek_state.f90 ek_deck ek_equilibrium
deck/ek_record.f90 ek_path ek_deck
formats/ek_kin.f90 ek_deck ek_formats
formats/ek_property.f90 ek_law ek_formats
results/ek_table.f90 ek_path ek_results
quantities/ek_attitude.f90 ek_study ek_quantities
math/ek_curve.f90 ek_law ek_math
model/ek_element_force.f90 ek_reader_elements ek_model
model/ek_law.f90 ek_kkt ek_model
deck/ek_mirror.f90 ek_rig ek_deck
deck/ek_namelist.f90 ek_load_deck ek_deck
equilibrium/ek_schedule.f90 ek_rig ek_equilibrium
results/ek_text_table.f90 ek_suspension ek_results
results/ek_test_result.f90 ek_gradient ek_results
results/ek_json.f90 ek_report ek_results
compliance/ek_compliance.f90 ek_deck ek_compliance
rig/ek_rig.f90 ek_reader ek_rig
quantities/ek_gradient.f90 ek_report ek_quantities
study/ek_study.f90 ek_report ek_study
os/ek_writer.f90 ek_table ek_os
math/ek_lapack.F90 ek_kkt ek_math
deck/ek_reader_bodies.f90 ek_balance ek_deck
equilibrium/ek_branch.f90 ek_compliance ek_equilibrium
equilibrium/ek_orientation.f90 ek_reader ek_equilibrium
results/ek_table.f90 ek_rig ek_results
plausible/ek_plausible_shape.f90 ek_reader ek_plausible
study/ek_response.f90 ek_run ek_study
api/ek_session.f90 ek_run ek_api
engine/ek_workspace.f90 ek_factor_numbers ek_engine
rig/ek_rig.f90 ek_workspace ek_rig
study/ek_study_design.f90 ek_derivatives ek_study
sensitivity/ek_derivatives.f90 ek_session ek_sensitivity
export/ek_kandc_map.f90 ek_export_settings ek_export
pages/ek_page.f90 ek_named_numbers ek_pages
numbers/ek_key_numbers.f90 ek_page ek_numbers
api/ek_named_numbers.f90 ek_page ek_api
sensitivity/ek_fit_problem.f90 ek_page ek_sensitivity
api/ek_named_numbers.f90 ek_load_deck ek_api
base/ek_text.f90 ek_system ek_base
base/ek_decimal.f90 ek_quantity ek_base
os/ek_file.f90 ek_quantity ek_os
vocabulary/ek_noise.f90 ek_file ek_vocabulary
compliance/ek_port_response.f90 ek_attitude ek_compliance
rig/ek_rig.f90 ek_attitude ek_rig
quantities/ek_sweep_table.f90 ek_remark ek_quantities
cases/ek_case_result.f90 ek_contribution ek_cases
plausible/ek_plausible_range.f90 ek_remark ek_plausible
shares/ek_contribution.f90 ek_plausible_range ek_shares
sampling/ek_sampler.f90 ek_study ek_sampling
figures/ek_chart.f90 ek_key_number ek_figures
scene/ek_scene.f90 ek_page ek_scene
pages/ek_page.f90 ek_comparison ek_pages
END
}

# Every `use` points downwards, and tools/check_layers.sh notices one that does not, an unknown module, two modules of one name, and a
# lock of ek_words that is not given back
uses_point_downwards() {
  local copy=$logs/uses file module wrong=0
  tools/check_layers.sh || return 1
  rm -rf "$copy"
  mkdir -p "$copy"
  cp -r src "$copy"
  noticed() { # noticed FILE SED-EXPRESSION MESSAGE: a copy with this change must be rejected
    cp "$copy/src/$1" "$copy/kept.f90"
    sed -i "$2" "$copy/src/$1"
    tools/check_layers.sh "$copy" >"$logs/uses.txt" && { echo "accepted: $1: $2"; wrong=1; }
    grep -F "$3" "$logs/uses.txt" || { echo "not noticed in $1: $2"; wrong=1; }
    cp "$copy/kept.f90" "$copy/src/$1"
  }
  while read -r file module _; do
    noticed "$file" "0,/^module .*/s//&\n   use $module/" "may not use $module of"
  done < <(upward_uses)
  noticed main.f90 '0,/^program .*/s//&\n   use ek_unknown/' 'there is no module ek_unknown'
  noticed math/ek_curve.f90 's/^module ek_curve/module ek_rotation/' 'module ek_rotation stands in'
  local begin='s/^\( *\)call begin_words()/&'
  noticed api/ek_c_model.f90 "$begin\n\1return/" 'leaves the procedure between begin_words'
  noticed api/ek_c_model.f90 "$begin\n\1if (is_done) return/" 'leaves the procedure between begin_words'
  noticed api/ek_c_model.f90 "$begin\n\1exit/" 'leaves the loop between begin_words'
  noticed api/ek_c_model.f90 '/call begin_words/d' 'end_words is called without begin_words'
  noticed api/ek_c_model.f90 '/call end_words/d' 'begin_words has no end_words'
  noticed api/ek_c_model.f90 's/call end_words()/   &/' 'end_words is not in the block of begin_words'
  noticed api/ek_c_model.f90 's/call begin_words/if (is_done) &/' 'begin_words is called on a condition'
  return $wrong
}

# In a copy of the sources each layer gets a `use` of a layer above it, which must not compile
upward_use_does_not_compile() {
  local work=$logs/layering file module target wrong=0
  rm -rf "$work"
  mkdir -p "$work"
  cp -r CMakeLists.txt src input "$work"      # the program contains decks of input
  cmake -S "$work" -B "$work/build" -DBUILD_TESTING=OFF -DCMAKE_BUILD_TYPE=Quick -DCMAKE_Fortran_FLAGS_QUICK=-O0 || return 1
  # everything compiles first, so that the module files exist that must not be found
  cmake --build "$work/build" --parallel "$EK_JOBS" || return 1
  while read -r file module target; do
    cp "$work/src/$file" "$work/kept.f90"
    sed -i "0,/^module .*/s//&\n   use $module/" "$work/src/$file"
    if cmake --build "$work/build" --target "$target" >"$work/said.txt" 2>&1; then
      echo "$file may use $module"
      wrong=1
    elif ! grep -q "Cannot open module file .$module.mod." "$work/said.txt"; then
      echo "$file with $module fails for another reason:"
      cat "$work/said.txt"
      wrong=1
    else
      echo "$file may not use $module"
    fi
    cp "$work/kept.f90" "$work/src/$file"
  done < <(upward_uses)
  return $wrong
}
