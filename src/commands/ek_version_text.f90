!> The output of `elastokin --version`: the version, the compiler and its options, and the libraries in use on this machine.
module ek_version_text
   use ek_version, only: version
   use ek_text, only: str, plural
   use ek_buffer, only: buffer_t
   use ek_file, only: join_path, program_exists
   use ek_system, only: program_folder
   use ek_loaded_library, only: library_with, text_from_library
   use ek_threads, only: processor_count
   use ek_lane_instructions, only: get_instruction_set
   use ek_study_pack, only: lanes, are_lanes_fast
   implicit none(type, external)
   private
   public :: build_t, program_name, version_text, build_text

   !> The facts of a build from CMake (src/ek_build_facts.f90.in). The main program passes these facts, so that after a new commit
   !> no other file is compiled again.
   type :: build_t
      character(60) :: commit       !! '' if the commit is unknown
      character(100) :: compiler
      character(400) :: options     !! build type and flags
      logical :: has_openmp, has_ipo
   end type build_t

contains

   !> The program with version and commit: 'elastokin 0.1.0 (commit 0c4ac0af68fa)'.
   pure function program_name(build) result(text)
      type(build_t), intent(in) :: build
      character(:), allocatable :: text

      text = 'elastokin '//version
      if (build%commit /= '') text = text//' (commit '//trim(build%commit)//')'
   end function program_name

   !> The facts of a build on which its numbers depend, in one line: version, commit, compiler and compiler options.
   pure function build_text(build) result(text)
      type(build_t), intent(in) :: build
      character(:), allocatable :: text
      text = program_name(build)//', '//trim(build%compiler)//', '//trim(build%options)
   end function build_text

   !> The output of --version: the version in the first line, then one fact per line.
   function version_text(build) result(text)
      type(build_t), intent(in) :: build
      character(:), allocatable :: text
      type(buffer_t) :: lines
      character(:), allocatable :: lapack, blas

      lapack = library_text('dsytrf_')
      blas = library_text('dgemm_')
      call lines%line('elastokin '//version)
      if (build%commit /= '') call lines%line('commit     '//trim(build%commit))
      call lines%line('compiler   '//trim(build%compiler))
      call lines%line('options    '//trim(build%options))
      call lines%line('IPO        '//yes_or_no(build%has_ipo))
      call lines%line('LAPACK     '//lapack)
      if (blas /= lapack) call lines%line('BLAS       '//blas)
      if (text_from_library('openblas_get_config') /= '') call lines%line('OpenBLAS   '// &
         text_from_library('openblas_get_config')//', kernels: '//text_from_library('openblas_get_corename'))
      if (build%has_openmp) then
         call lines%line('OpenMP     yes, '//plural(processor_count(), 'processor', 'processors'))
      else
         call lines%line('OpenMP     no')
      end if
      call lines%line('SIMD batch '//pack_text())
      call lines%line('MPI        '//beside('elastokin-mpi'))
      call lines%line('NetCDF     '//beside('elastokin-netcdf'))
      text = lines%text()
   end function version_text

   !> The instruction set of SIMD batches, from the copy of the kernels in use: 'x86-64-v3 (AVX2), 4 designs at a time'. A phrase that
   !> begins with 'no' if the compiler does not vectorise packs.
   function pack_text() result(text)
      character(:), allocatable :: text
      character(60) :: name

      text = 'no, this compiler does not vectorise them'
      if (.not. are_lanes_fast) return
      text = str(lanes)//' designs at a time'
      call get_instruction_set(name)
      if (name == '') return
      if (name == 'x86-64-v3') name(10:) = ' (AVX2)'
      if (name == 'x86-64') name(7:) = ' (SSE2)'
      text = trim(name)//', '//text
   end function pack_text

   !> The path of the library that contains a symbol, or 'part of the program (static)'.
   function library_text(symbol) result(text)
      character(*), intent(in) :: symbol
      character(:), allocatable :: text, program

      text = library_with(symbol)
      program = library_with('main')
      if (text == '' .or. text == program) text = 'part of the program (static)'
   end function library_text

   !> Phrase about whether a program is in the folder of this program: 'yes' and the path, or 'no' and the reason.
   function beside(name) result(text)
      character(*), intent(in) :: name
      character(:), allocatable :: text

      text = 'no, '//name//' is not in the folder of this program'
      if (program_exists(join_path(program_folder(), name))) text = 'yes, '//join_path(program_folder(), name)
   end function beside

   pure function yes_or_no(is_so) result(text)
      logical, intent(in) :: is_so
      character(:), allocatable :: text
      text = trim(merge('yes', 'no ', is_so))
   end function yes_or_no

end module ek_version_text
