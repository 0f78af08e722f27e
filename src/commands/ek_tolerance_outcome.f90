!> Results of a tolerance study in addition to its designs: the moments of its responses by derivatives and from the designs, as
!> tables and as printed lines.
module ek_tolerance_outcome
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_error, only: error_t, message_list_t
   use ek_text, only: str, plural
   use ek_buffer, only: buffer_t
   use ek_file, only: join_path
   use ek_sampler_kind, only: tolerance_kind
   use ek_study_data, only: study_data_t, methods
   use ek_study_results, only: read_results_of
   use ek_tolerance, only: find_tolerance
   use ek_moment_tables, only: take_tolerance, take_sample, write_moments
   use ek_study_list, only: list_tables
   use ek_opened_study, only: opened_study_t
   use ek_console, only: print_text, print_warning
   use ek_outbox, only: outbox_t, outbox_in
   implicit none(type, external)
   private
   public :: expand_study, write_tolerance

   integer, parameter :: most_listed = 8             !! largest number of listed factors of a response
   real(wp), parameter :: least_listed = 0.005_wp    !! smallest share of the variance of a listed factor
   integer, parameter :: width = 13

contains

   !> Computes the derivatives of a tolerance study before its designs, so that a missing derivative is reported before any design
   !> is solved. Other kinds of study do not need derivatives.
   subroutine expand_study(this, error)
      type(opened_study_t), intent(inout) :: this
      type(error_t), allocatable, intent(out) :: error     !! exit_deck, exit_model
      integer :: k

      if (this%study%kind /= tolerance_kind) return
      allocate (this%tolerance)
      call find_tolerance(this%study, this%deck, this%designer, this%tolerance, error)
      if (allocated(error)) deallocate (this%tolerance)
      if (allocated(error)) return
      do k = 1, this%tolerance%failures%count()
         call print_warning(this%tolerance%failures%line(k))
      end do
   end subroutine expand_study

   !> Writes the tables of moments, and prints their paths and the moments.
   subroutine write_tolerance(this, is_quiet, error)
      type(opened_study_t), intent(in) :: this
      logical, intent(in) :: is_quiet
      type(error_t), allocatable, intent(out) :: error     !! exit_file
      class(study_data_t), allocatable :: data
      type(message_list_t) :: names
      type(outbox_t) :: box
      type(buffer_t) :: text
      integer :: k

      allocate (data)
      call read_results_of(this%study, this%deck, join_path(this%home, ''), this%out, data, error)
      if (allocated(error)) return
      if (allocated(data%moments)) deallocate (data%moments)           ! of a run before
      if (allocated(data%expected)) deallocate (data%expected)
      call take_tolerance(this%tolerance, this%study%columns, data)
      call take_sample(data)
      call write_moments(data, this%out, names, error)
      if (.not. allocated(error)) call list_tables(this%study%name, this%out, names, is_quiet, error, is_more=.true.)
      box = outbox_in(this%out)
      do k = 1, names%count()
         if (.not. allocated(error)) call box%announce(names%line(k))
      end do
      call box%finish(error)
      do k = 1, size(data%responses)
         call add_response(data, k, text)
      end do
      if (.not. allocated(error)) call print_text(text%text(), error)
   end subroutine write_tolerance

   !> Adds the moments of a response by each method, the factors with the largest shares of the variance, and the shares of the
   !> interactions and of the nonlinear terms.
   subroutine add_response(data, r, text)
      type(study_data_t), intent(in) :: data
      integer, intent(in) :: r
      type(buffer_t), intent(inout) :: text
      logical :: is_free(size(data%factors)), has_limits
      integer :: f, k, m

      associate (axis => data%responses(r), effects => data%effects(r), nominal => data%effects(r)%nominal)
         has_limits = axis%lower > -huge(1.0_wp) .or. axis%upper < huge(1.0_wp)
         call text%line(axis%name//' = '//str(nominal, 6)//' at the centre of all factors')
         call text%add(repeat(' ', width)//right('mean', width)//right('deviation', width)//right('skewness', width)// &
            right('5 %', width)//right('95 %', width))
         if (has_limits) call text%add(right('within', width))
         call text%line('')
         do m = 1, size(methods)
            associate (row => data%moments(m, r))
               call text%add(methods(m)//repeat(' ', width - len(methods(m)))//number(row%mean)//number(row%deviation)// &
                  number(row%skewness, 3)//number(row%low)//number(row%high))
               if (has_limits) call text%add(right(percent(row%within), width))
               call text%line('')
            end associate
         end do
         associate (row => data%moments(3, r))
            if (ieee_is_finite(row%mean)) then
               call text%add('+-, 95 %     '//number(row%mean_half, 2)//number(row%deviation_half, 2))
               if (has_limits .and. ieee_is_finite(row%within_low)) call text%add(repeat(' ', 2*width)// &
                  right(percent(row%within_low)//' to '//percent(row%within_high), 2*width))
               if (has_limits .and. .not. ieee_is_finite(row%within_low)) call text%add(repeat(' ', 3*width)//right('-', width))
               call text%add('   of '//plural(data%summaries(r)%used, 'design', 'designs'))
               if (has_limits .and. data%summaries(r)%used < data%designs) call text%add('; within: of all '//str(data%designs))
               call text%line('')
            end if
         end associate
         if (.not. abs(data%moments(2, r)%deviation) > 0.0_wp) then
            call text%line('no shares of the variance: all derivatives at the centre are zero')
            return
         end if
         call text%line('share of the variance:')
         is_free = .true.
         do k = 1, min(most_listed, size(data%factors))
            f = maxloc(effects%first, dim=1, mask=is_free)
            is_free(f) = .false.
            if (effects%first(f) < least_listed) exit
            call text%line('  '//data%factors(f)%name//repeat(' ', max(1, 40 - len(data%factors(f)%name)))// &
               right(percent(effects%first(f)), 7))
         end do
         call text%line('  interactions'//repeat(' ', 28)//right(percent(1.0_wp - sum(effects%first)), 7))
         call text%line('  not linear'//repeat(' ', 30)// &
            right(percent(1.0_wp - (data%moments(1, r)%deviation/data%moments(2, r)%deviation)**2), 7))
      end associate
   end subroutine add_response

   !> A number, padded with blanks to the width of its column.
   function number(value, digits) result(text)
      real(wp), intent(in) :: value
      integer, intent(in), optional :: digits
      character(:), allocatable :: text
      integer :: many

      many = 5
      if (present(digits)) many = digits
      text = right('-', width)
      if (ieee_is_finite(value)) text = right(str(value, many), width)
   end function number

   !> A share in percent: '97.3 %'.
   function percent(share) result(text)
      real(wp), intent(in) :: share
      character(:), allocatable :: text

      text = '-'
      if (ieee_is_finite(share)) text = str(0.01_wp*nint(10000.0_wp*share), 6)//' %'
   end function percent

   !> A string, padded with blanks on the left to the width of its column.
   pure function right(text, places) result(padded)
      character(*), intent(in) :: text
      integer, intent(in) :: places
      character(:), allocatable :: padded
      padded = repeat(' ', max(1, places - len(text)))//text
   end function right

end module ek_tolerance_outcome
