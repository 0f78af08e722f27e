!> The conditions of `elastokin solve`: the options --for and --weight, and the target bands of the deck as weights.
module ek_solve_conditions
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_error, only: error_t, message_list_t, fail, exit_usage
   use ek_text, only: str, quoted, suggestion
   use ek_decimal, only: get_bounded, size_hint
   use ek_key_number, only: nothing
   use ek_target_band, only: target_band_t
   use ek_response_bands, only: number_at_design
   use ek_table, only: name_length
   use ek_workspace, only: workspace_t
   use ek_workspace_cases, only: case_number
   use ek_wanted_number, only: wanted_number_t, find_wanted
   use ek_command_line, only: command_line_t
   use ek_load_deck, only: deck_settings_t
   implicit none(type, external)
   private
   public :: read_conditions

   character(*), parameter :: keep = 'keep'         !! value of --for: the value at the start

contains

   !> Reads the conditions of --for, each [case:]quantity[@swept value]=value, and their weights; reports all errors.
   !> The weight of a condition is that of --weight, otherwise half the width of the target band of the deck for its quantity.
   subroutine read_conditions(line, settings, workspace, wanted, targets, weights, origins, error)
      type(command_line_t), intent(in) :: line
      type(deck_settings_t), intent(in) :: settings
      type(workspace_t), intent(in) :: workspace
      type(wanted_number_t), allocatable, intent(out) :: wanted(:)
      real(wp), allocatable, intent(out) :: targets(:)       !! NaN: the value at the start
      real(wp), allocatable, intent(out) :: weights(:)       !! NaN: not given
      type(message_list_t), intent(out) :: origins           !! description of the band of each weight; '' without a band
      type(error_t), allocatable, intent(out) :: error
      type(message_list_t) :: given, mistakes
      type(error_t), allocatable :: fault
      character(:), allocatable :: text, whole, case, place, usual
      real(wp) :: at
      logical :: is_number
      integer :: k, j, c, mark

      usual = line%value('--at', '0')
      place = ''
      given = line%values('--for')
      allocate (wanted(given%count()), targets(given%count()))
      do k = 1, given%count()
         text = given%line(k)
         mark = index(text, '=', back=.true.)
         is_number = .false.
         targets(k) = nothing()
         if (mark > 1) is_number = trim(adjustl(text(mark + 1:))) == keep
         if (mark > 1 .and. .not. is_number) call get_bounded(trim(adjustl(text(mark + 1:))), targets(k), is_number)
         if (.not. is_number) then
            call mistakes%add('--for '//text//': expected quantity=value, case:quantity=value or quantity@swept value=value'// &
               size_hint(text(mark + 1:)))
            cycle
         end if
         whole = trim(adjustl(text(:mark - 1)))
         call split(whole, case, text, place)
         mark = index(whole, '@')
         if (index(whole, ':') == 0) case = settings%case
         if (mark == 0) place = usual
         call get_bounded(trim(adjustl(place)), at, is_number)
         if (.not. is_number) then
            call mistakes%add(trim(merge('--for', '--at ', mark > 0))//': expected a swept value, found '//quoted(place)// &
               size_hint(place))
            cycle
         end if
         c = case_number(case, workspace)
         if (c == 0) then
            call mistakes%add(unknown_case(case, settings%file, workspace))
            cycle
         end if
         call find_wanted(workspace, c, text, at, wanted(k), fault)
         if (allocated(fault)) call mistakes%add('--for '//fault%message)
         if (allocated(fault)) cycle
         do j = 1, k - 1
            if (.not. allocated(wanted(j)%name)) cycle
            if (wanted(j)%name == text .and. wanted(j)%case == wanted(k)%case .and. abs(wanted(j)%at - at) <= 0.0_wp) &
               call mistakes%add('--for: '//quoted(text)//' is given twice')
         end do
      end do
      call read_weights(line%values('--weight'), wanted, workspace, weights, mistakes)
      do k = 1, size(wanted)
         call take_band(workspace%design%targets, wanted(k), weights(k), text)
         call origins%add(text)
      end do
      if (mistakes%count() > 0) call fail(error, exit_usage, mistakes%text())
   end subroutine read_conditions

   !> Sets a weight that is not given to half the width of the band of the deck (&target_band) for the quantity: a key number, or a
   !> column at design. A band with one limit has no width. If a quantity has several bands, the last band counts, as in a report.
   subroutine take_band(bands, wanted, weight, origin)
      type(target_band_t), intent(in) :: bands(:)
      type(wanted_number_t), intent(in) :: wanted
      real(wp), intent(inout) :: weight                      !! NaN: not given
      character(:), allocatable, intent(out) :: origin       !! description of the band; '' if the weight is not that of a band
      character(:), allocatable :: name
      integer :: t

      origin = ''
      if (ieee_is_finite(weight)) return
      name = ''
      if (allocated(wanted%key)) then
         name = wanted%key%name
      else if (.not. abs(wanted%at) > 0.0_wp) then
         name = number_at_design(trim(wanted%column))
      end if
      if (name == '') return
      do t = size(bands), 1, -1
         if (bands(t)%quantity == name) exit
      end do
      if (t == 0) return
      if (.not. (bands(t)%low > -huge(1.0_wp) .and. bands(t)%high < huge(1.0_wp))) return
      if (.not. bands(t)%high > bands(t)%low) return
      weight = 0.5_wp*(bands(t)%high - bands(t)%low)
      origin = ', half the width of the target band '//str(bands(t)%low, 9)//' to '//str(bands(t)%high, 9)//' of '//bands(t)%where
   end subroutine take_band

   !> Splits [case:]quantity[@swept value] into its parts; a part that is not given is ''.
   subroutine split(text, case, name, place)
      character(*), intent(in) :: text
      character(:), allocatable, intent(out) :: case, name, place
      integer :: mark

      mark = index(text, ':')
      case = text(:max(0, mark - 1))
      name = text(mark + 1:)
      place = ''
      mark = index(name, '@')
      if (mark == 0) return
      place = name(mark + 1:)
      name = trim(name(:mark - 1))
   end subroutine split

   !> Reads the weights of --weight, each [case:]quantity[@swept value]=size. Without a case or a swept value, the weight belongs to
   !> all conditions of its quantity.
   subroutine read_weights(given, wanted, workspace, weights, mistakes)
      type(message_list_t), intent(in) :: given
      type(wanted_number_t), intent(in) :: wanted(:)
      type(workspace_t), intent(in) :: workspace
      real(wp), allocatable, intent(out) :: weights(:)
      type(message_list_t), intent(inout) :: mistakes
      character(:), allocatable :: text, case, name, place
      character(name_length), allocatable :: names(:)
      real(wp) :: size_of, at
      logical :: is_number, is_used
      integer :: k, j, mark

      allocate (weights(size(wanted)), source=nothing())
      allocate (names(0))
      do j = 1, size(wanted)
         if (allocated(wanted(j)%name)) names = [character(name_length) :: names, wanted(j)%name]
      end do
      do k = 1, given%count()
         text = given%line(k)
         mark = index(text, '=', back=.true.)
         is_number = .false.
         if (mark > 1) call get_bounded(trim(adjustl(text(mark + 1:))), size_of, is_number)
         if (is_number) is_number = size_of > 0.0_wp
         if (.not. is_number) then
            call mistakes%add('--weight '//text//': expected quantity=size, a deviation above 0 in the unit of the quantity'// &
               size_hint(text(mark + 1:)))
            cycle
         end if
         call split(trim(adjustl(text(:mark - 1))), case, name, place)
         at = 0.0_wp
         if (place /= '') call get_bounded(trim(adjustl(place)), at, is_number)
         is_used = .false.
         do j = 1, size(wanted)
            if (.not. allocated(wanted(j)%name) .or. .not. is_number) cycle
            if (wanted(j)%name /= name) cycle
            if (case /= '' .and. wanted(j)%case /= case_number(case, workspace)) cycle
            if (place /= '' .and. abs(wanted(j)%at - at) > 0.0_wp) cycle
            weights(j) = size_of
            is_used = .true.
         end do
         if (.not. is_used) call mistakes%add('--weight '//text//': there is no such condition in --for'//suggestion(name, names))
      end do
   end subroutine read_weights

   !> Message about a case that the deck does not have.
   function unknown_case(name, file, workspace) result(text)
      character(*), intent(in) :: name, file
      type(workspace_t), intent(in) :: workspace
      character(:), allocatable :: text
      character(name_length) :: names(size(workspace%cases))
      integer :: j

      do j = 1, size(names)
         names(j) = workspace%cases(j)%case%name
      end do
      text = 'no case '//quoted(name)//' in '//file//', and no standard test of this name'//suggestion(name, names)
      if (size(names) == 0) text = file//': no &case group and no wheel, so there is no case to solve'
   end function unknown_case

end module ek_solve_conditions
