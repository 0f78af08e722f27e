!> The log of settings: the numbers and strings of a deck that several settings change (--set-file, --set), and which of the
!> settings decides. A setting of one side of a mirrored axle is applied after all settings of records that the deck itself contains.
module ek_setting_log
   use ek_error, only: message_list_t
   use ek_text, only: quoted
   use ek_deck, only: deck_t, finish_deck
   use ek_matched_numbers, only: match_t, match_records, match_name
   use ek_record, only: record_t
   implicit none(type, external)
   private
   public :: applied_t, add_applied, overridden_settings

   !> One setting that was applied.
   type :: setting_t
      character(:), allocatable :: where           !! '--set' or 'params.in:3'
      character(:), allocatable :: path, value
      logical :: is_late = .false.                 !! the setting changes a record that the deck itself does not contain
   end type setting_t

   !> The settings of a command, in the order in which they were given.
   type :: applied_t
      private
      type(setting_t), allocatable :: list(:)
   end type applied_t

   !> An element of a record that a setting changed.
   type :: changed_t
      type(match_t) :: number
      integer :: setting = 0
   end type changed_t

contains

   !> Adds a setting of the command line, or of a line of a set file.
   subroutine add_applied(applied, where, path, value)
      type(applied_t), intent(inout) :: applied
      character(*), intent(in) :: where            !! '--set', or file and line
      character(*), intent(in) :: path, value
      type(setting_t) :: this

      if (.not. allocated(applied%list)) allocate (applied%list(0))
      this%where = where
      this%path = path
      this%value = value
      applied%list = [applied%list, this]
   end subroutine add_applied

   !> Lists the settings that override others, or change a number again (*1.1, +2), one message per pair of settings: the number,
   !> the setting that decides, and the former setting.
   subroutine overridden_settings(applied, deck, messages)
      type(applied_t), intent(inout) :: applied
      type(deck_t), intent(in) :: deck             !! deck with all settings
      type(message_list_t), intent(out) :: messages
      type(deck_t) :: whole
      type(changed_t), allocatable :: changed(:)
      type(match_t), allocatable :: these(:)
      integer, allocatable :: order(:)
      integer :: k, j, i, former
      logical :: is_relative

      if (.not. allocated(applied%list)) return
      if (size(applied%list) < 2) return
      call finish_deck(deck, whole)
      do k = 1, size(applied%list)
         call match_records(deck%records(:deck%used), applied%list(k)%path, .false., these)
         applied%list(k)%is_late = size(these) == 0
      end do
      order = [(k, k=1, size(applied%list))]
      order = [pack(order, .not. applied%list%is_late), pack(order, applied%list%is_late)]
      allocate (changed(0))
      do k = 1, size(order)
         associate (this => applied%list(order(k)))
            is_relative = scan(this%value, '*+') == 1
            call match_records(whole%records(:whole%used), this%path, is_relative, these)
            former = 0
            do j = 1, size(these)
               i = place_of(these(j), changed)
               if (i == 0) then
                  changed = [changed, changed_t(these(j), order(k))]
                  cycle
               end if
               if (former /= changed(i)%setting) then
                  former = changed(i)%setting
                  call add_message(applied%list(former), this, is_relative, whole%records, these(j), these)
               end if
               changed(i)%setting = order(k)
            end do
         end associate
      end do

   contains

      subroutine add_message(former, this, is_relative, records, number, all)
         type(setting_t), intent(in) :: former, this
         logical, intent(in) :: is_relative
         type(record_t), intent(in) :: records(:)
         type(match_t), intent(in) :: number, all(:)
         character(:), allocatable :: verb

         verb = ' overrides '
         if (is_relative) verb = ' is applied after '
         call messages%add(match_name(records, number, all)//': '//shown(this)//verb//shown(former))
      end subroutine add_message

      !> A setting as given, with its location.
      function shown(this) result(text)
         type(setting_t), intent(in) :: this
         character(:), allocatable :: text

         text = '--set '//this%path//'='//this%value
         if (this%where /= '--set') text = this%path//' = '//this%value//' ('//this%where//')'
      end function shown

   end subroutine overridden_settings

   !> Index of a number among the changed numbers; 0 if no setting has changed it.
   pure integer function place_of(this, changed) result(k)
      type(match_t), intent(in) :: this
      type(changed_t), intent(in) :: changed(:)

      do k = 1, size(changed)
         associate (other => changed(k)%number)
            if (other%record == this%record .and. other%at == this%at .and. other%key == this%key) return
         end associate
      end do
      k = 0
   end function place_of

end module ek_setting_log
