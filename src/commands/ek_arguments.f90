!> The command line as values: one command, its files, its options. ek_command reads it.
module ek_arguments
   use ek_gradient_definition, only: windows_t
   implicit none(type, external)
   private
   public :: arguments_t, setting_t

   !> A text of its own length.
   type :: setting_t
      character(:), allocatable :: text
   end type setting_t

   !> The options of the command line; texts that were not given are empty.
   type :: arguments_t
      character(:), allocatable :: command      !! name of a command, or '' for help or version
      character(:), allocatable :: file         !! deck or study; '-' is standard input
      type(setting_t), allocatable :: files(:)  !! all files given; `file` is the first; only compare accepts several
      character(:), allocatable :: out          !! folder of the results; '' if not given to study, whose folder it is beside
      character(:), allocatable :: method, case
      type(setting_t), allocatable :: settings(:)   !! path=value
      type(windows_t) :: windows                !! of gradients
      integer :: increments = 0                 !! 0: as in the deck
      logical :: json = .false.                 !! print an object instead of lines
      logical :: compliance = .false.           !! also write the compliance matrix at every state
      logical :: plot = .false., no_plots = .false., animate = .false.
      logical :: quiet = .false., help = .false., version = .false.
   end type arguments_t

end module ek_arguments
