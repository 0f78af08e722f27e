!> Files of other programs that are known and not read: what they are, and what to export instead.
module ek_unread_format
   use ek_text, only: lower
   implicit none(type, external)
   private
   public :: advice_on

   !> A format: an extension, or text at the beginning of the file. The advice names the program and the remedy.
   type :: format_t
      character(8) :: extension
      character(28) :: words            !! lower case, in the first 2000 characters; '' if only the extension counts
      character(132) :: advice
   end type format_t

   character(*), parameter :: as_table = 'export its hardpoints as a table (name, x, y, z)'
   type(format_t), parameter :: formats(*) = [ &
      format_t('adm', 'adams/view model name', 'a data set of Adams/Solver; export the subsystem (.sub), or '//as_table), &
      format_t('cmd', 'defaults model', 'a command file of Adams/View; export the subsystem (.sub), or '//as_table), &
      format_t('bin', '', 'a binary database of Adams/View; export the subsystem (.sub), or '//as_table), &
      format_t('mdl', '*beginmdl', 'a model of MotionView; '//as_table), &
      format_t('mdl', '*topology', 'a model of MotionView; '//as_table), &
      format_t('o3d', '', 'a binary project of OptimumKinematics; '//as_table), &
      format_t('opk', '', 'a binary project of OptimumKinematics; '//as_table), &
      format_t('par', 'parsfile', 'a data set of CarSim with tables, without hardpoints; export the hardpoints of its source'), &
      format_t('skc', '#infofile1', 'tables of CarMaker, without hardpoints; export the hardpoints of its source'), &
      format_t('kex', '', 'results of IPGKinematics; import the axle (.kin)'), &
      format_t('spck', '', 'a model of Simpack; '//as_table), &
      format_t('xls', '', 'a workbook; save the sheet as CSV'), &
      format_t('slx', '', 'a model of Simulink; '//as_table), &
      format_t('fmu', '', 'a compiled model; '//as_table), &
      format_t('step', 'iso-10303-21', 'a drawing (STEP); '//as_table), &
      format_t('stp', 'iso-10303-21', 'a drawing (STEP); '//as_table)]

contains

   !> What a file is and what to export instead; '' for another file. The text at the beginning counts also for
   !> another extension; an extension without such text counts alone.
   pure function advice_on(path, content) result(advice)
      character(*), intent(in) :: path, content
      character(:), allocatable :: advice
      character(:), allocatable :: extension, folded
      integer :: k

      advice = ''
      extension = lower(path(index(path, '.', back=.true.) + 1:))
      folded = lower(content(:min(len(content), 2000)))
      do k = 1, size(formats)
         if (formats(k)%words /= '') then
            if (index(folded, trim(formats(k)%words)) == 0) cycle
         else if (extension /= formats(k)%extension) then
            cycle
         end if
         advice = 'this is '//trim(formats(k)%advice)
         return
      end do
   end function advice_on

end module ek_unread_format
