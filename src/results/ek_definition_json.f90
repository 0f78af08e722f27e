!> A row of the definitions of other programs as JSON.
module ek_definition_json
   use ek_error, only: message_list_t
   use ek_json, only: json_t, json_string, json_strings
   use ek_formula, only: formula_t
   use ek_definition_rows, only: definition_t
   use ek_definition, only: status_of, formula_of, has_no_column
   implicit none(type, external)
   private
   public :: add_definition

contains

   !> Adds the items of a row to an open object.
   subroutine add_definition(json, row)
      type(json_t), intent(inout) :: json
      type(definition_t), intent(in) :: row

      call json%item('name', json_string(trim(row%name)))
      call json%item('unit', json_string(trim(row%unit)))
      call json%item('positive', json_string(trim(row%positive)))
      call json%item('status', json_string(status_of(row)))
      call json%item('column', json_string(trim(row%ours)))
      call json%item('formula', json_string(trim(row%formula)))
      call json%item('columns', json_strings(columns_of(row)))
      call json%item('difference', json_string(trim(row%difference)))
      call json%item('errs', json_string(trim(row%errs)))
   end subroutine add_definition

   !> The columns of elastokin in a formula.
   function columns_of(row) result(columns)
      type(definition_t), intent(in) :: row
      type(message_list_t) :: columns
      type(formula_t) :: formula
      integer :: v

      if (row%formula == '') return
      formula = formula_of(row)
      do v = 1, formula%used
         if (.not. has_no_column(formula%variables(v))) call columns%add(trim(formula%variables(v)))
      end do
   end function columns_of

end module ek_definition_json
