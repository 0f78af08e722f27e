!> The files of elastokin explain: the contributions of all states as a table and as JSON, and the load paths of all states as a
!> table.
module ek_explain_files
   use ek_kinds, only: wp
   use ek_error, only: error_t
   use ek_text, only: str
   use ek_frame, only: frame_t, new_frame
   use ek_json, only: json_t, json_string, json_number, json_numbers
   use ek_quantity, only: unit_of, unit_text
   use ek_suspension, only: suspension_t
   use ek_element, only: element_kinds
   use ek_writer, only: writer_t, begin_file
   use ek_contribution, only: of_element, of_joint
   use ek_contribution_table, only: contribution_table_t
   use ek_wheel_side, only: prefix_of, deck_frame
   implicit none(type, external)
   private
   public :: explain_files_t, begin_explain_files, add_explain_state, end_explain_files, begin_explain_case, &
      end_explain_case, end_explain_json

   character(1), parameter :: axes(3) = ['x', 'y', 'z']

   type :: explain_files_t
      type(writer_t) :: shares, paths
      type(frame_t) :: share_rows, path_rows       !! rows that are not written yet
      character(:), allocatable :: case
      logical :: has_json = .false.
      type(json_t) :: json                   !! object with the contributions of all cases
   end type explain_files_t

contains

   !> Begins the table of contributions and the table of load paths of a case.
   subroutine begin_explain_files(name, case, header, self, error)
      character(*), intent(in) :: name                 !! path without its extension
      character(*), intent(in) :: case, header         !! name of the case; header: model, case, program, checksum
      type(explain_files_t), intent(inout) :: self
      type(error_t), allocatable, intent(out) :: error

      self%case = case
      call begin_file(self%shares, name//'_contributions.csv', error)
      if (allocated(error)) return
      call begin_file(self%paths, name//'_load_paths.csv', error)
      if (allocated(error)) call self%shares%abandon()
      if (allocated(error)) return
      self%share_rows = new_frame('case,state,factor,column,column_value,row,kind,part,value,unit,share')
      call self%share_rows%header%add(header)
      call self%share_rows%header%add('the values of a column and state add up to column_value; rows of 0 are omitted')
      self%path_rows = new_frame('case,state,factor,load,row,kind,fx_n_per_n,fy_n_per_n,fz_n_per_n,mx_nm_per_n,my_nm_per_n,'// &
         'mz_nm_per_n,energy_share')
      call self%path_rows%header%add(header)
      call self%path_rows%header%add('per newton at a contact point: on the second body, at its point, frame of the deck')
      call pass_rows(self)
   end subroutine begin_explain_files

   !> Adds a state to the tables, and to the JSON object.
   subroutine add_explain_state(suspension, state, factor, table, self)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: state                     !! index of the state; the first is 0
      real(wp), intent(in) :: factor                   !! swept value in the unit of the case
      type(contribution_table_t), intent(in) :: table
      type(explain_files_t), intent(inout) :: self
      character(:), allocatable :: name, unit
      integer :: c, e

      do c = 1, size(table%values)
         name = trim(table%columns%names(table%columns%asked(c)))
         unit = unit_text(unit_of(name))
         associate (rows => self%share_rows)
            call rows%put(self%case)
            call rows%put(state)
            call rows%put(factor)
            call rows%put(name)
            call rows%put(table%values(c))
            call rows%hold()
            do e = 1, size(table%row)
               if (.not. abs(table%parts(c, e)) > 0.0_wp) cycle
               call rows%put(trim(table%row(e)%row))
               call rows%put(trim(table%row(e)%kind))
               call rows%put(trim(table%row(e)%part))
               call rows%put(table%parts(c, e))
               call rows%put(unit)
               call rows%put(share_of(table%parts(c, e), table%values(c)))
            end do
            call rows%release()
         end associate
      end do
      call add_paths(suspension, self%case, state, factor, table, self%path_rows)
      call pass_rows(self)
      if (self%has_json) call add_json_state(state, factor, table, self%json)
   end subroutine add_explain_state

   !> Writes the rows that were added since the last call.
   subroutine pass_rows(self)
      type(explain_files_t), intent(inout) :: self
      character(:), allocatable :: text

      call self%share_rows%next_csv(text)
      call self%shares%add(text)
      call self%path_rows%next_csv(text)
      call self%paths%add(text)
   end subroutine pass_rows

   !> Adds the load paths of a state as rows.
   subroutine add_paths(suspension, case, state, factor, table, rows)
      type(suspension_t), intent(in) :: suspension
      character(*), intent(in) :: case
      integer, intent(in) :: state
      real(wp), intent(in) :: factor                   !! swept value in the unit of the case
      type(contribution_table_t), intent(in) :: table
      type(frame_t), intent(inout) :: rows
      character(:), allocatable :: load, name, kind
      real(wp) :: frame(3), energy
      integer :: j, k, elements, item, sort

      call rows%put(case)
      call rows%put(state)
      call rows%put(factor)
      call rows%hold()
      frame = deck_frame(suspension)
      elements = size(suspension%elements)
      do j = 1, size(table%energy, 1)
         load = prefix_of(suspension, table%columns%kandc%compliance%order((j + 2)/3))//'f'//axes(mod(j - 1, 3) + 1)
         do k = 1, elements + size(suspension%joints)
            item = merge(k, k - elements, k <= elements)
            sort = merge(of_element, of_joint, k <= elements)
            if (k <= elements) then
               name = suspension%elements(k)%name
               kind = trim(element_kinds(suspension%elements(k)%kind)%label)
            else
               name = suspension%joints(item)%name
               kind = suspension%joints(item)%kind
            end if
            energy = sum(table%energy(j, :), mask=table%shares%share%kind == sort .and. table%shares%share%item == item)
            call rows%put(load)
            call rows%put(name)
            call rows%put(kind)
            call rows%put(frame*frame(mod(j - 1, 3) + 1)*table%paths%force(:, j, k))
            call rows%put(frame*frame(mod(j - 1, 3) + 1)*table%paths%moment(:, j, k))
            call rows%put(energy)
         end do
      end do
      call rows%release()
   end subroutine add_paths

   !> Ends both tables. The complete files then exist; after an error, no temporary file remains.
   subroutine end_explain_files(self, error)
      type(explain_files_t), intent(inout) :: self
      type(error_t), allocatable, intent(out) :: error

      call self%shares%finish(error)
      if (.not. allocated(error)) call self%paths%finish(error)
      call self%paths%abandon()                        ! no effect on a finished table
   end subroutine end_explain_files

   !> The ratio value/whole [-]; 0 if whole is 0.
   pure real(wp) function share_of(value, whole) result(share)
      real(wp), intent(in) :: value, whole

      share = 0.0_wp
      if (abs(whole) > 0.0_wp) share = value/whole
   end function share_of

   !> Begins the output of a case: its name, the unit of the swept value, and the list of rows, which does not depend on the state.
   subroutine begin_explain_case(name, unit_name, table, json)
      character(*), intent(in) :: name, unit_name      !! name of the case; unit of the swept value
      type(contribution_table_t), intent(in) :: table
      type(json_t), intent(inout) :: json
      integer :: k

      call json%open('{')
      call json%item('name', json_string(name))
      call json%item('factor_unit', json_string(unit_name))
      call json%open('[', 'rows')
      do k = 1, size(table%row)
         call json%open('{')
         call json%item('row', json_string(trim(table%row(k)%row)))
         call json%item('kind', json_string(trim(table%row(k)%kind)))
         call json%item('part', json_string(trim(table%row(k)%part)))
         call json%close('}')
      end do
      call json%close(']')
      call json%open('[', 'states')
   end subroutine begin_explain_case

   subroutine end_explain_case(json)
      type(json_t), intent(inout) :: json

      call json%close(']')
      call json%close('}')
   end subroutine end_explain_case

   subroutine end_explain_json(json)
      type(json_t), intent(inout) :: json

      call json%close(']')
      call json%close('}')
   end subroutine end_explain_json

   !> Adds one state: the value of every column, and the contribution of every row to each column.
   subroutine add_json_state(state, factor, table, json)
      integer, intent(in) :: state
      real(wp), intent(in) :: factor
      type(contribution_table_t), intent(in) :: table
      type(json_t), intent(inout) :: json
      character(:), allocatable :: name
      integer :: c

      call json%open('{')
      call json%item('state', str(state))
      call json%item('factor', json_number(factor))
      call json%open('[', 'columns')
      do c = 1, size(table%values)
         name = trim(table%columns%names(table%columns%asked(c)))
         call json%open('{')
         call json%item('name', json_string(name))
         call json%item('unit', json_string(unit_text(unit_of(name))))
         call json%item('value', json_number(table%values(c)))
         call json%item('contributions', json_numbers(table%parts(c, :)))
         call json%close('}')
      end do
      call json%close(']')
      call json%close('}')
   end subroutine add_json_state

end module ek_explain_files
