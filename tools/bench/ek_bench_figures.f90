!> The measurements of elastokin-bench on a deck, as lines and as a JSON object.
module ek_bench_figures
   use ek_kinds, only: wp
   use ek_text, only: str
   use ek_case, only: method_names
   use ek_json, only: json_t, json_string, json_number
   use ek_increment_parts, only: parts_t
   implicit none(type, external)
   private
   public :: figures_t, table_of, json_of, short_sweep

   character(*), parameter :: nl = new_line('a')

   integer, parameter :: short_sweep = 20     !! increments of a timed design, as in a study

   !> The measured values. Times are processor times, so that a busy machine does not change them.
   type :: figures_t
      character(:), allocatable :: model, case
      integer :: increments = 0, n = 0       !! increments of the case; order of the matrix
      real(wp) :: unit = 0.0_wp              !! time of dsysv [s]
      real(wp) :: increment(2) = huge(1.0_wp)    !! time per increment of recursive and corrected, by LAPACK [s]
      type(parts_t) :: lapack, plan          !! times of method equilibrium with each solver
      real(wp) :: pack_states = 0.0_wp       !! states per second of packs of four designs; 0: not measured
      real(wp) :: alone = 0.0_wp             !! share of the states of packs that were solved one design at a time
      integer :: nonzeros = 0, length = 0    !! entries of the lower triangle of the matrix; numbers in its factors by plan
      integer :: fallbacks = 0               !! factorisations per sweep that LAPACK repeated: the factors by plan were not sound
      real(wp) :: factorisations = 0.0_wp    !! mean number of factorisations per state
      integer :: most = 0                    !! largest number of factorisations of a state
      real(wp) :: distance = 0.0_wp          !! largest distance from the solution at tolerance 1e-13 m [m]
      real(wp) :: kandc_row = 0.0_wp         !! time of the compliance matrix of all wheels at a state, by plan [s]; 0: no wheel
      real(wp) :: kandc_all = 0.0_wp         !! time of the compliance matrix and all K&C quantities, by plan [s]; 0: no wheel
      real(wp) :: design = 0.0_wp  !! time of a design of short_sweep increments, from numbers to a column [s]; 0: not measured
      real(wp) :: loads = 0.0_wp             !! time of all manoeuvres with the loads on all parts, by plan [s]; 0: no manoeuvres
      real(wp) :: states = 0.0_wp            !! time of the states and the column of this design alone [s]
   end type figures_t

contains

   !> The measured times as lines for the terminal.
   function table_of(figures) result(text)
      type(figures_t), intent(in) :: figures
      character(:), allocatable :: text
      character(200) :: line
      integer :: m

      text = 'model '//figures%model//', case '//figures%case//', '//str(figures%increments)//' increments, matrix '// &
         str(figures%n)//' x '//str(figures%n)//nl//timing('LAPACK dsysv alone', figures%unit, figures%unit)
      do m = 1, 2
         text = text//timing(trim(method_names(m))//' increment', figures%increment(m), figures%unit)
      end do
      text = text//timing('equilibrium increment', figures%lapack%increment, figures%unit)// &
         timing('equilibrium by plan', figures%plan%increment, figures%unit)//parts_of('by LAPACK', figures%lapack)// &
         parts_of('by plan', figures%plan)//'plan: '//str(figures%nonzeros)//' numbers of the matrix, '//str(figures%length)// &
         ' with fill, dense '//str((figures%n*(figures%n + 1))/2)//', by LAPACK instead '//str(figures%fallbacks)//nl// &
         'converged states per second: by LAPACK '//per_second(figures%lapack%increment)//', by plan '// &
         per_second(figures%plan%increment)
      if (figures%pack_states > 0.0_wp) text = text//', in packs of four designs '//str(nint(figures%pack_states))// &
         ' per core ('//str(nint(100.0_wp*figures%alone))//' % of them one design at a time)'
      text = text//nl
      write (line, '(a,f5.3,a,i0)') 'equilibrium: factorisations per state ', figures%factorisations, ', at most ', figures%most
      text = text//trim(line)//nl
      write (line, '(a,es8.1,a)') 'equilibrium: largest distance to the solution at tolerance 1e-10 mm: ', &
         figures%distance*1000.0_wp, ' mm'
      text = text//trim(line)//nl
      if (figures%kandc_row > 0.0_wp) then
         text = text//'K&C row by plan: compliance matrix of all wheels '//microseconds(figures%kandc_row)//', rows per second '// &
            per_second(figures%kandc_row)//'; with all quantities '//microseconds(figures%kandc_all)//', rows per second '// &
            per_second(figures%kandc_all)//nl
      end if
      if (figures%loads > 0.0_wp) then
         write (line, '(a,i0,a,f0.2,a)') 'manoeuvres by plan: ', figures%increments + 1, ' with the loads on all parts in ', &
            figures%loads*1.0e3_wp, ' ms'
         text = text//trim(line)//nl
      end if
      if (.not. figures%design > 0.0_wp) return
      text = text//'design of '//str(short_sweep)//' increments, from numbers to a column: '//microseconds(figures%design)//', '// &
         microseconds(max(figures%design - figures%states, 0.0_wp))//' more than its states and the column; designs per second '// &
         per_second(figures%design)//nl
   end function table_of

   !> The times of the parts of an increment as a line.
   function parts_of(name, parts) result(text)
      character(*), intent(in) :: name
      type(parts_t), intent(in) :: parts
      character(:), allocatable :: text

      text = name//': assembly '//microseconds(parts%assembly)//', factor '//microseconds(parts%factor)//', solve '// &
         microseconds(parts%solve)//', rest '//microseconds(parts%rest)//nl
   end function parts_of

   !> A time with its unit: '12.3 us'.
   function microseconds(time) result(text)
      real(wp), intent(in) :: time         !! s
      character(:), allocatable :: text
      character(20) :: number

      write (number, '(f20.1)') time*1.0e6_wp
      text = trim(adjustl(number))//' us'
   end function microseconds

   !> The reciprocal of a time [1/s], rounded to the nearest integer.
   function per_second(time) result(text)
      real(wp), intent(in) :: time         !! s
      character(:), allocatable :: text
      text = str(nint(1.0_wp/time))
   end function per_second

   !> A line with name, time in microseconds, and time ratio.
   function timing(name, time, unit) result(line)
      character(*), intent(in) :: name
      real(wp), intent(in) :: time, unit
      character(:), allocatable :: line
      character(100) :: words

      write (words, '(a,t28,f9.3,a,f7.2,a)') name, time*1.0e6_wp, ' us', time/unit, ' units'
      line = trim(words)//nl
   end function timing

   !> The measured values as a JSON object.
   function json_of(figures) result(text)
      type(figures_t), intent(in) :: figures
      character(:), allocatable :: text
      type(json_t) :: json
      integer :: m

      call json%open('{')
      call json%item('model', json_string(figures%model))
      call json%item('case', json_string(figures%case))
      call json%item('increments', str(figures%increments))
      call json%item('n', str(figures%n))
      call json%item('unit_us', json_number(figures%unit*1.0e6_wp))
      do m = 1, 2
         call json%item(trim(method_names(m))//'_units', json_number(figures%increment(m)/figures%unit))
      end do
      call json%item('equilibrium_units', json_number(figures%lapack%increment/figures%unit))
      call json%item('lapack_units', json_number(figures%lapack%increment/figures%unit))
      call json%item('plan_units', json_number(figures%plan%increment/figures%unit))
      call add_parts('lapack', figures%lapack)
      call add_parts('plan', figures%plan)
      call json%item('states_per_s', json_number(1.0_wp/figures%lapack%increment))
      call json%item('plan_states_per_s', json_number(1.0_wp/figures%plan%increment))
      if (figures%pack_states > 0.0_wp) call json%item('pack_states_per_s', json_number(figures%pack_states))
      call json%item('factorisations_per_state', json_number(figures%factorisations))
      call json%item('max_factorisations', str(figures%most))
      call json%item('distance_mm', json_number(figures%distance*1000.0_wp))
      if (figures%kandc_row > 0.0_wp) then
         call json%item('kandc_row_us', json_number(figures%kandc_row*1.0e6_wp))
         call json%item('kandc_all_us', json_number(figures%kandc_all*1.0e6_wp))
      end if
      if (figures%loads > 0.0_wp) call json%item('loads_ms', json_number(figures%loads*1.0e3_wp))
      if (figures%design > 0.0_wp) then
         call json%item('design_us', json_number(figures%design*1.0e6_wp))
         call json%item('design_states_us', json_number(figures%states*1.0e6_wp))
         call json%item('designs_per_s', json_number(1.0_wp/figures%design))
      end if
      call json%close('}')
      text = json%text()

   contains

      subroutine add_parts(name, parts)
         character(*), intent(in) :: name
         type(parts_t), intent(in) :: parts

         call json%item(name//'_assembly_us', json_number(parts%assembly*1.0e6_wp))
         call json%item(name//'_factor_us', json_number(parts%factor*1.0e6_wp))
         call json%item(name//'_solve_us', json_number(parts%solve*1.0e6_wp))
         call json%item(name//'_rest_us', json_number(parts%rest*1.0e6_wp))
      end subroutine add_parts

   end function json_of

end module ek_bench_figures
