!> The content of a report: its tests, their charts, gradients and key numbers, and the facts at the top of the page.
module ek_report_content
   use ek_error, only: message_list_t
   use ek_path, only: path_t
   use ek_test_result, only: test_result_t
   use ek_chart, only: chart_t
   use ek_figure, only: figure_t
   use ek_gradient, only: gradient_t
   use ek_key_number, only: key_number_t
   use ek_member_loads, only: load_record_t
   use ek_part_record, only: part_record_t
   use ek_measurement, only: measurement_t
   use ek_explanation, only: explanation_t
   use ek_live, only: live_t
   use ek_turntable, only: turntable_t
   use ek_assessment, only: axle_kind_t
   use ek_tilt, only: tilt_t
   use ek_defined_numbers, only: defined_numbers_t
   implicit none(type, external)
   private
   public :: report_t, add_fact

   !> A report: its tests, and the other contents of its page.
   type :: report_t
      character(:), allocatable :: title, folder
      type(message_list_t) :: names, values            !! facts for the top of the page
      character(:), allocatable :: start               !! start state of the tests, if the deck does not hold it (ek_load_state)
      type(message_list_t) :: warnings                 !! warnings on the model as a whole
      type(message_list_t) :: deck_paths, deck_texts   !! paths and values of the deck (ek_deck_values)
      type(test_result_t), allocatable :: tests(:)
      type(path_t), allocatable :: paths(:)            !! states of each test, for pictures; empty if the test was not run
      type(chart_t), allocatable :: charts(:)          !! charts of all tests
      type(figure_t), allocatable :: figures(:)        !! views of the hardpoints, carpets and envelopes of tests on a grid
      type(gradient_t), allocatable :: gradients(:)
      type(key_number_t), allocatable :: numbers(:)    !! key numbers of the tests
      type(key_number_t), allocatable :: missing(:)    !! key numbers without a value, which are not among `numbers`
      type(load_record_t), allocatable :: loads        !! loads of the members, if requested
      type(part_record_t), allocatable :: parts        !! loads on the parts in states with names, if there are such states
      type(measurement_t), allocatable :: measured(:)  !! measured curves, if given
      type(explanation_t), allocatable :: explanations(:)     !! contributions to the rates and the key compliances
      type(live_t), allocatable :: live                !! rates that the page can change, if requested
      type(turntable_t), allocatable :: turntable      !! the suspension in space, if something moves
      type(tilt_t), allocatable :: tilts(:)            !! rated tilts of joints and bushings
      type(defined_numbers_t), allocatable :: defined  !! numbers in the definitions of another program, if requested
      type(axle_kind_t) :: axle = axle_kind_t()        !! class and position of the axle, for its usual ranges
      type(message_list_t) :: drawn                    !! scripts and pictures of this report, relative to the folder
      type(message_list_t) :: copies                   !! copies of the load tables of the deck, in the folder
      integer :: incomplete = 0                        !! number of tests that failed or were not run to their ends
      logical :: is_static = .false.                   !! the page has the pictures of gnuplot, and no script
      logical :: has_pictures = .false., has_animation = .false.   !! files of this report are in the folder
   end type report_t

contains

   !> Adds a fact for the top of the page.
   subroutine add_fact(report, name, value)
      type(report_t), intent(inout) :: report
      character(*), intent(in) :: name, value
      call report%names%add(name)
      call report%values%add(value)
   end subroutine add_fact

end module ek_report_content
