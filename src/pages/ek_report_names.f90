!> The file names of a report, and lists of the files that a report can have. This is one table for the commands that write,
!> read and remove the files.
module ek_report_names
   implicit none(type, external)
   private
   public :: contents_file, gradients_file, compliance_file, numbers_file, deck_file, used_deck_file, gradients_json_file, &
      numbers_json_file, data_file, page_file, loads_file, peaks_file, list_file, files_of_reports, files_of_loads, &
      is_table_of_report, measured_file, envelope_file, loads_json_file, parts_folder, part_file, windows_folder, &
      definitions_folder, files_of_definitions, definitions_file, definitions_json_file

   character(*), parameter :: contents_file = 'tests.csv', gradients_file = 'gradients.csv', compliance_file = 'compliance.csv', &
      numbers_file = 'key_numbers.csv', deck_file = 'deck.csv', used_deck_file = 'deck_as_used.nml', &
      gradients_json_file = 'gradients.json', numbers_json_file = 'key_numbers.json', data_file = 'data.json', &
      page_file = 'report.html', loads_file = 'loads.csv', peaks_file = 'peak-loads.csv', &
      envelope_file = 'load-envelope.csv', loads_json_file = 'loads.json', parts_folder = 'parts', &
      windows_folder = 'windows', measured_file = 'measured-curves.csv', definitions_folder = 'definitions', &
      definitions_file = 'definitions.csv', definitions_json_file = 'definitions.json'
   character(*), parameter :: list_file = 'report-files.csv'     !! no test has a hyphen in its name

   !> Files that every report can have.
   character(*), parameter :: files_of_reports(*) = [character(18) :: contents_file, gradients_file, gradients_json_file, &
      compliance_file, numbers_file, numbers_json_file, deck_file, used_deck_file, data_file, page_file]

   !> Additional files of a report with --loads.
   character(*), parameter :: files_of_loads(*) = [character(18) :: loads_file, peaks_file]

   !> Additional files of a report with --definitions.
   character(*), parameter :: files_of_definitions(*) = [character(18) :: definitions_file, definitions_json_file]

contains

   !> The file of the loads on a part, relative to the folder of the results.
   pure function part_file(part) result(file)
      character(*), intent(in) :: part
      character(:), allocatable :: file
      file = parts_folder//'/'//part//'.csv'
   end function part_file

   !> Whether a name is the name of a report table that is not the table of a test.
   pure logical function is_table_of_report(name)
      character(*), intent(in) :: name
      is_table_of_report = any(files_of_reports == name) .or. any(files_of_loads == name) .or. name == list_file .or. &
         name == envelope_file .or. name == measured_file .or. any(files_of_definitions == name)
   end function is_table_of_report

end module ek_report_names
