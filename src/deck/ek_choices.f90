!> The strings that a key of a deck accepts: the single list for the reader and for `elastokin schema`.
!>
!> Letter case is ignored. The readers use the index of a string in its list.
module ek_choices
   use ek_dimension, only: length_names, force_names, angle_names, mass_names
   use ek_rig_test, only: rig_tests
   use ek_usual_range, only: class_names
   use ek_joint, only: joint_kinds
   use ek_new_curve, only: curve_kinds
   use ek_case, only: method_names, solver_names, follow_names
   use ek_group, only: group_names, word_length
   use ek_manoeuvre_records, only: set_names
   implicit none(type, external)
   private
   public :: choices_of

contains

   !> The strings that a key accepts; of size 0 if the key accepts any value.
   pure function choices_of(group, key) result(words)
      integer, intent(in) :: group
      character(*), intent(in) :: key
      character(word_length), allocatable :: words(:)

      select case (trim(group_names(group))//'.'//key)
      case ('model.length')
         words = [character(word_length) :: length_names]
      case ('model.force')
         words = [character(word_length) :: force_names]
      case ('model.angle')
         words = [character(word_length) :: angle_names]
      case ('model.mass')
         words = [character(word_length) :: mass_names]
      case ('model.axes', 'hardpoints.axes')
         words = [character(word_length) :: 'x-rear', 'iso']
      case ('model.balance')
         words = [character(word_length) :: 'none', 'spring', 'all']
      case ('model.start')
         words = [character(word_length) :: 'height', 'loads']
      case ('hardpoints.side')
         words = [character(word_length) :: 'left', 'right', 'both']
      case ('measure.type')
         words = [character(word_length) :: 'axes', 'gap', 'global_gap', 'distance', 'rotation']
      case ('joint.type')
         words = [character(word_length) :: joint_kinds]
      case ('curve.kind', 'bushing.property_kind', 'spring.property_kind', 'stop.property_kind')
         words = [character(word_length) :: curve_kinds]
      case ('stop.type')
         words = [character(word_length) :: 'bump', 'rebound']
      case ('wheel.side', 'manoeuvre.side')
         words = [character(word_length) :: 'left', 'right']
      case ('axle.position')
         words = [character(word_length) :: 'front', 'rear']
      case ('axle.class')
         words = [character(word_length) :: class_names]
      case ('axle.drive_reaction')
         words = [character(word_length) :: 'wheel_centre', 'patch']
      case ('axle.brake_reaction')
         words = [character(word_length) :: 'carrier', 'body']
      case ('load.factor')
         words = [character(word_length) :: 'constant', 'case']
      case ('adjuster.type')
         words = [character(word_length) :: 'rod', 'shim', 'slot', 'seat']
      case ('manoeuvre.set')
         words = [character(word_length) :: set_names]
      case ('manoeuvre.longitudinal_by')
         words = [character(word_length) :: 'brake', 'drive', 'obstacle']
      case ('case.pose')
         words = [character(word_length) :: 'settled', 'design']
      case ('case.test')
         words = [character(word_length) :: rig_tests%name]
      case ('case.vertical')
         words = [character(word_length) :: 'centre', 'patch', 'force', 'road']
      case ('case.phase')
         words = [character(word_length) :: 'in', 'anti']
      case ('case.quantities')
         words = [character(word_length) :: 'basic', 'all']
      case ('case.method')
         words = [character(word_length) :: method_names]
      case ('case.solver')
         words = [character(word_length) :: solver_names]
      case ('case.follow')
         words = [character(word_length) :: follow_names]
      case default
         allocate (words(0))
      end select
   end function choices_of

end module ek_choices
