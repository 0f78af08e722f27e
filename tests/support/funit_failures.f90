!> What the assertions of module funit have found wrong in the running test.
!>
!> The one place of the stand-in with module state: an assertion inside a helper has no argument
!> through which it could tell the runner. A test program is one process and runs its tests in turn.
module funit_failures
  use, intrinsic :: ieee_exceptions, only: ieee_get_halting_mode, ieee_invalid, ieee_set_flag, ieee_set_halting_mode
  implicit none(type, external)
  private

  public :: SourceLocation, throw, anyExceptions, next_failure, suspend_traps, restore_traps

  !> Where an assertion stands; the name and the order of the components are pFUnit's.
  type :: SourceLocation
    character(len=80) :: file = ''
    integer :: line = 0
  end type SourceLocation

  type :: failure_t
    character(len=:), allocatable :: place   !! `file:line`, or empty for a call without location
    character(len=:), allocatable :: text
  end type failure_t

  type(failure_t), allocatable :: failures(:)

contains

  !> An assertion compares NaN too: where the program traps invalid operations, it must not end there.
  subroutine suspend_traps(saved)
    logical, intent(out) :: saved
    call ieee_get_halting_mode(ieee_invalid, saved)
    call ieee_set_halting_mode(ieee_invalid, .false.)
  end subroutine suspend_traps

  !> Back to what suspend_traps found.
  subroutine restore_traps(saved)
    logical, intent(in) :: saved
    call ieee_set_flag(ieee_invalid, .false.)
    call ieee_set_halting_mode(ieee_invalid, saved)
  end subroutine restore_traps

  !> Note one failure. `message` is the user's, `text` says what was expected and found.
  subroutine throw(text, message, location)
    character(len=*), intent(in) :: text
    character(len=*), intent(in), optional :: message
    type(SourceLocation), intent(in), optional :: location

    type(failure_t) :: new
    character(len=12) :: digits

    new%text = text
    if (present(message)) then
      if (len(text) > 0) new%text = trim(message) // ': ' // text
      if (len(text) == 0) new%text = trim(message)
    end if
    new%place = ''
    if (present(location)) then
      write (digits, '(i0)') location%line
      new%place = trim(location%file) // ':' // trim(digits)
    end if
    if (.not. allocated(failures)) allocate (failures(0))
    failures = [failures, new]
  end subroutine throw

  !> Has the running test failed? The preprocessor puts this after every assertion.
  logical function anyExceptions()
    anyExceptions = .false.
    if (allocated(failures)) anyExceptions = size(failures) > 0
  end function anyExceptions

  !> Hand the oldest failure to the runner and forget it; `place` and `text` stay unallocated if none.
  subroutine next_failure(place, text)
    character(len=:), allocatable, intent(out) :: place, text

    if (.not. anyExceptions()) return
    place = failures(1)%place
    text = failures(1)%text
    failures = failures(2:)
  end subroutine next_failure

end module funit_failures
