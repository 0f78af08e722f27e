!> elastokin export: computes kinematics and compliance of a deck as tables, and writes them as files that another simulator reads.
!>
!> A new format needs its own file in src/export and, here, its name and its line in the help, and its case in `export`.
module ek_export
   use ek_kinds, only: wp
   use ek_error, only: error_t
   use ek_file, only: make_folder
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t, default_tolerance
   use ek_workspace, only: workspace_t, balance_or_explain
   use ek_reader, only: definition_t
   use ek_table, only: table_t
   use ek_model_remark, only: model_remarks_t, find_model_remarks
   use ek_command_line, only: command_line_t
   use ek_load_deck, only: load_deck, spare_results
   use ek_console, only: print_model_remarks
   use ek_outbox, only: outbox_t, outbox_in
   use ek_export_settings, only: export_settings_t, read_export_settings, make_request, front_of
   use ek_kandc_map, only: kandc_map_t, solve_map
   use ek_map_request, only: map_request_t
   use ek_load_response, only: load_table_result_t, solve_loads
   use ek_monotonic, only: check_monotonic, check_steer
   use ek_carmaker, only: carmaker_text
   use ek_carsim, only: carsim_text
   use ek_mathworks, only: kandc_parameters_t, find_parameters, mathworks_script, mathworks_json, corner_names
   use ek_plain_tables, only: kinematics_table, defined_map_table, loads_table, compliance_of_map, tables_json
   use ek_export_sources, only: sources_t, solve_sources
   use ek_export_figure, only: panel_list_t, export_figure
   use ek_figure_script, only: figure_script
   use ek_export_panels, only: carmaker_panels, carsim_panels, mathworks_panels, csv_panels
   implicit none(type, external)
   private
   public :: export, target_words, target_help

   character, parameter :: nl = new_line('a')
   character(10), parameter :: names(3) = [character(10) :: 'kinematics', 'loads', 'compliance']      !! tables of --to csv

   character(*), parameter :: defined_ending = '_definitions.csv'      !! of the table of --definitions

   ! The formats, for --to and for the help
   character(*), parameter :: targets(*) = [character(9) :: 'carmaker', 'carsim', 'matlab-kc', 'csv']
   character(*), parameter :: target_words = 'carmaker | carsim | matlab-kc | csv'
   character(*), parameter :: target_help = &
      '  carmaker: <model>.skc, with kinematics over travel and steer (or travel of the other wheel), and compliance;'//nl// &
      '  carsim: <model>_carsim.par, with tables over jounce, and compliance coefficients;'//nl// &
      '  matlab-kc: <model>_kandc.m and .json, with parameters of "Independent Suspension - K and C";'//nl// &
      '  csv: <model>_kinematics.csv, _loads.csv, _compliance.csv, and _tables.json with all three tables.'

   !> The model of a deck, the requested map, the solved map, the checksum of the deck, and whether the axle is the front axle.
   type :: axle_map_t
      type(suspension_t) :: suspension
      type(map_request_t) :: request
      type(kandc_map_t) :: map
      character(:), allocatable :: checksum
      logical :: is_front = .true.
   end type axle_map_t

contains

   !> Runs the export. Everything is solved first: if a number cannot be computed, no file is written.
   subroutine export(line, error)
      type(command_line_t), intent(in) :: line
      type(error_t), allocatable, intent(out) :: error
      type(export_settings_t) :: settings
      type(axle_map_t) :: axle
      type(outbox_t) :: box
      type(panel_list_t) :: panels
      type(sources_t) :: sources
      character(:), allocatable :: reason, name
      character(1) :: separator

      call read_export_settings(line, targets, settings, error)
      if (.not. allocated(error)) call solve_axle(settings, axle, error)
      if (.not. allocated(error) .and. settings%has_plots) call solve_sources(axle%suspension, axle%request, axle%map, &
         settings%target /= 'carmaker', sources, error)
      if (allocated(error)) return
      box = outbox_in(settings%out)
      separator = ','
      select case (settings%target)
      case ('carmaker')
         separator = ' '
         call write_carmaker(settings, axle, sources, panels, box, error)
         name = axle%map%model//'_carmaker'
      case ('carsim')
         call write_carsim(settings, axle, sources, panels, box, error)
         name = axle%map%model//'_carsim'
      case ('matlab-kc')
         separator = ' '
         call write_mathworks(settings, axle, sources, panels, box, error)
         name = axle%map%model//'_kandc'
      case default
         call write_tables(settings, axle, sources, panels, box, error)
         name = axle%map%model//'_tables'
      end select
      if (allocated(error)) return
      if (settings%has_plots .and. .not. box%has_failed()) then
         if (panels%used > 0) call box%add_script(name, figure_script(export_figure(panels, name, &
            axle%map%title//': '//settings%target, separator)))
         call box%draw(settings%is_quiet, reason)
         if (len(reason) == 0) call box%announce(name//'.png')
      end if
      call box%finish(error)
   end subroutine export

   !> Reads the deck of the settings, applies the preload trim (`balance`), and solves the map.
   subroutine solve_axle(settings, axle, error)
      type(export_settings_t), intent(in) :: settings
      type(axle_map_t), intent(out) :: axle
      type(error_t), allocatable, intent(out) :: error
      class(workspace_t), allocatable :: workspace
      type(definition_t), target :: definition
      type(model_remarks_t) :: remarks
      integer :: k

      call load_deck(settings, definition, workspace, axle%checksum, error)
      if (allocated(error)) return
      do k = 1, merge(size(names), 0, settings%target == 'csv')
         call spare_results(trim(names(k)), workspace%deck_cases, error)
      end do
      if (.not. allocated(error) .and. allocated(settings%program)) call spare_results('definitions', workspace%deck_cases, error)
      if (.not. allocated(error)) call make_request(settings, workspace%raw, workspace%deck_cases, axle%request, error)
      if (.not. allocated(error) .and. (settings%target == 'carmaker' .or. settings%target == 'matlab-kc')) &
         call front_of(settings, workspace%raw, axle%is_front, error)
      if (.not. allocated(error)) call balance_or_explain(default_tolerance, workspace, error)
      if (allocated(error)) return
      axle%suspension = workspace%suspension
      call find_model_remarks(axle%suspension, workspace%raw, workspace%deck_cases, workspace%deck_cases, .true., remarks)
      call print_model_remarks(settings%is_quiet, remarks)
      if (allocated(settings%program)) then
         call solve_map(axle%suspension, axle%request, axle%map, error, settings%program)
      else
         call solve_map(axle%suspension, axle%request, axle%map, error)
      end if
   end subroutine solve_axle

   subroutine write_carmaker(settings, axle, sources, panels, box, error)
      type(export_settings_t), intent(in) :: settings
      type(axle_map_t), intent(in) :: axle
      type(sources_t), intent(in) :: sources
      type(panel_list_t), intent(out) :: panels
      type(outbox_t), intent(inout) :: box
      type(error_t), allocatable, intent(out) :: error
      character(:), allocatable :: text

      call carmaker_text(axle%map, axle%is_front, axle%checksum, text, error)
      if (.not. allocated(error)) call make_folder(settings%out, error)
      if (allocated(error)) return
      call box%put(axle%map%model//'.skc', text)
      if (.not. settings%has_plots) return
      call carmaker_panels(axle%map, sources, axle%map%model//'.skc', text, panels)
   end subroutine write_carmaker

   subroutine write_carsim(settings, axle, sources, panels, box, error)
      type(export_settings_t), intent(in) :: settings
      type(axle_map_t), intent(in) :: axle
      type(sources_t), intent(in) :: sources
      type(panel_list_t), intent(out) :: panels
      type(outbox_t), intent(inout) :: box
      type(error_t), allocatable, intent(out) :: error
      character(:), allocatable :: text

      call carsim_text(axle%map, axle%checksum, text, error)
      if (.not. allocated(error)) call make_folder(settings%out, error)
      if (allocated(error)) return
      call box%put(axle%map%model//'_carsim.par', text)
      if (.not. settings%has_plots) return
      call carsim_panels(axle%map, sources, axle%map%model//'_carsim.par', text, panels)
   end subroutine write_carsim

   !> Writes the script and the JSON file. If the deck of the other axle is given, both files contain both axles.
   subroutine write_mathworks(settings, axle, sources, panels, box, error)
      type(export_settings_t), intent(in) :: settings
      type(axle_map_t), intent(in) :: axle
      type(sources_t), intent(in) :: sources
      type(panel_list_t), intent(out) :: panels
      type(outbox_t), intent(inout) :: box
      type(error_t), allocatable, intent(out) :: error
      type(kandc_parameters_t) :: p
      character(:), allocatable :: text
      integer :: place, k

      place = merge(1, 2, axle%is_front)
      p%maps(place) = axle%map
      p%has(place) = .true.
      p%checksums(place) = axle%checksum
      if (settings%other /= '') call add_other(settings, 3 - place, p, error)
      do k = 1, 2
         if (.not. allocated(error) .and. p%has(k)) call check_monotonic(p%maps(k), 'matlab-kc', .false., error)
         if (.not. allocated(error) .and. p%has(k)) call check_steer(p%maps(k), 'matlab-kc', error)
      end do
      if (.not. allocated(error)) call make_folder(settings%out, error)
      if (allocated(error)) return
      call find_parameters(p)
      text = mathworks_script(p)
      call box%put(axle%map%model//'_kandc.m', text)
      call box%put(axle%map%model//'_kandc.json', mathworks_json(p))
      if (.not. settings%has_plots) return
      call mathworks_panels(sources, axle%map%model//'_kandc.m', text, corner_names(2*place - 2 + sources%side), &
         size(axle%map%travel), panels)
   end subroutine write_mathworks

   !> Solves the deck of the other axle. The steer range and the driver come from this deck. The options --set, --axle, --driver,
   !> --map and --steer do not apply to the other axle.
   subroutine add_other(settings, place, p, error)
      type(export_settings_t), intent(in) :: settings
      integer, intent(in) :: place                       !! 1 front, 2 rear
      type(kandc_parameters_t), intent(inout) :: p
      type(error_t), allocatable, intent(out) :: error
      type(export_settings_t) :: theirs
      type(axle_map_t) :: other

      theirs%file = settings%other
      theirs%target = settings%target
      theirs%map = ''
      theirs%driver = ''
      theirs%vertical = settings%vertical
      theirs%held = settings%held
      theirs%axle = trim(merge('front', 'rear ', place == 1))
      theirs%signs = ''
      theirs%other = ''
      theirs%travel = settings%travel
      theirs%lengths = settings%lengths
      theirs%is_quiet = settings%is_quiet
      call solve_axle(theirs, other, error)
      if (allocated(error)) then
         error%message = '--other '//settings%other//': '//error%message
         return
      end if
      p%maps(place) = other%map
      p%has(place) = .true.
      p%checksums(place) = other%checksum
   end subroutine add_other

   !> Writes the tables of kinematics, loads and compliance as CSV files, and all three tables as one JSON file.
   subroutine write_tables(settings, axle, sources, panels, box, error)
      type(export_settings_t), intent(in) :: settings
      type(axle_map_t), intent(in) :: axle
      type(sources_t), intent(in) :: sources
      type(panel_list_t), intent(out) :: panels
      type(outbox_t), intent(inout) :: box
      type(error_t), allocatable, intent(out) :: error
      type(table_t) :: tables(3)
      type(load_table_result_t) :: loads
      real(wp) :: force, moment
      integer :: count, k
      logical :: is_sae

      force = 2000.0_wp
      moment = 100.0_wp
      count = 21
      if (settings%loads%is_given) then
         force = settings%loads%from
         moment = settings%loads%to
         count = settings%loads%points
      end if
      call solve_loads(axle%suspension, axle%request, force, moment, count, .true., loads, error)
      if (allocated(error)) return
      is_sae = settings%signs == 'sae'
      tables(1) = kinematics_table(axle%map, is_sae, axle%checksum)
      tables(2) = loads_table(axle%map, loads, is_sae, axle%checksum)
      tables(3) = compliance_of_map(axle%map, is_sae, axle%checksum)
      call make_folder(settings%out, error)
      if (allocated(error)) return
      do k = 1, 3
         call box%put(axle%map%model//'_'//trim(names(k))//'.csv', tables(k))
      end do
      if (allocated(axle%map%defined)) call box%put(axle%map%model//defined_ending, defined_map_table(axle%map, axle%checksum))
      call box%put(axle%map%model//'_tables.json', tables_json(names, tables, axle%map, is_sae, axle%checksum))
      if (.not. settings%has_plots) return
      call csv_panels(axle%map, sources, axle%map%model//'_kinematics.csv', is_sae, panels)
   end subroutine write_tables

end module ek_export
