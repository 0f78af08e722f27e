!> Remarks on the solution of a case as data: notes, warnings and errors, in the order in which they were found.
module ek_remark
   use ek_kinds, only: wp
   use ek_text, only: str, quoted
   use ek_case, only: case_t
   implicit none(type, external)
   private
   public :: remark_t, remark_list_t, swept_words
   public :: note, warning, failure
   public :: on_case, on_end, on_settling, on_drift, on_travel, on_stability, on_rack, on_curve, on_closure

   ! severities
   integer, parameter :: note = 1        !! the results are sound
   integer, parameter :: warning = 2     !! results may be unreliable
   integer, parameter :: failure = 3     !! results are missing, or marked converged = 0

   ! topics
   integer, parameter :: on_case = 0     !! the case was not run
   integer, parameter :: on_end = 1, on_settling = 2, on_drift = 3, on_travel = 4, on_stability = 5, on_rack = 6, on_curve = 7
   integer, parameter :: on_closure = 8

   !> One remark.
   type :: remark_t
      integer :: severity = note, topic = on_case
      character(:), allocatable :: case      !! name of the case
      character(:), allocatable :: head      !! "case 'x'", "case 'x', method recursive"; '' for on_case
      character(:), allocatable :: text      !! one or more lines
      logical :: has_place = .false.
      real(wp) :: place = 0.0_wp             !! swept value to which it applies, SI
   contains
      procedure :: whole                     !! text of the remark with its head
   end type remark_t

   !> The remarks on a case.
   type :: remark_list_t
      type(remark_t), allocatable, private :: remarks(:)
   contains
      procedure :: add => list_add
      procedure :: count => list_count
      procedure :: item => list_item
      procedure :: failures => list_failures
      procedure :: has_failed => list_has_failed
   end type remark_list_t

contains

   !> A swept value of a case on the rig: 'wheel travel = 12.5 mm'.
   pure function swept_words(case, value, digits) result(text)
      type(case_t), intent(in) :: case
      real(wp), intent(in) :: value      !! SI
      integer, intent(in) :: digits
      character(:), allocatable :: text

      text = case%place_name//' = '//str(value/case%unit, digits)
      if (case%unit_name /= '-') text = text//' '//case%unit_name
   end function swept_words

   !> 'case 'x': text'
   pure function whole(self) result(text)
      class(remark_t), intent(in) :: self
      character(:), allocatable :: text

      text = self%text
      if (len(self%head) > 0) text = self%head//': '//text
   end function whole

   !> Adds a remark; an empty text adds nothing.
   pure subroutine list_add(self, severity, topic, case, text, place, is_of_method)
      class(remark_list_t), intent(inout) :: self
      integer, intent(in) :: severity, topic
      type(case_t), intent(in) :: case
      character(*), intent(in) :: text
      real(wp), intent(in), optional :: place           !! swept value, SI
      logical, intent(in), optional :: is_of_method     !! the head names the method
      type(remark_t) :: new

      if (len(text) == 0) return
      new%severity = severity
      new%topic = topic
      new%case = case%name
      new%text = text
      new%head = ''
      if (topic /= on_case) new%head = 'case '//quoted(case%name)
      if (present(is_of_method)) new%head = new%head//', method '//case%method
      new%has_place = present(place)
      if (present(place)) new%place = place
      if (.not. allocated(self%remarks)) allocate (self%remarks(0))
      self%remarks = [self%remarks, new]
   end subroutine list_add

   pure integer function list_count(self)
      class(remark_list_t), intent(in) :: self
      list_count = 0
      if (allocated(self%remarks)) list_count = size(self%remarks)
   end function list_count

   pure type(remark_t) function list_item(self, k)
      class(remark_list_t), intent(in) :: self
      integer, intent(in) :: k
      list_item = self%remarks(k)
   end function list_item

   pure logical function list_has_failed(self)
      class(remark_list_t), intent(in) :: self

      list_has_failed = .false.
      if (allocated(self%remarks)) list_has_failed = any(self%remarks%severity == failure)
   end function list_has_failed

   !> All failures, one after the other; '' if there are none.
   pure function list_failures(self) result(text)
      class(remark_list_t), intent(in) :: self
      character(:), allocatable :: text
      integer :: k

      text = ''
      do k = 1, self%count()
         if (self%remarks(k)%severity /= failure) cycle
         if (len(text) > 0) text = text//new_line('a')
         text = text//self%remarks(k)%whole()
      end do
   end function list_failures

end module ek_remark
