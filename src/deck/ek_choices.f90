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
   use ek_group, only: group_names, word_length, key_t, curves, model_group, body_group, case_group, curve_group, load_state_group
   use ek_manoeuvre_records, only: set_names
   implicit none(type, external)
   private
   public :: choices_of, named_group, built_in_name

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

   !> Index of the group whose items the strings of a key name; 0 if they name no items. The curves of a bushing are named as
   !> 'fx=name'.
   pure integer function named_group(row)
      type(key_t), intent(in) :: row        !! row of the key in the table of keys

      named_group = row%role
      if (row%role == curves .or. row%name == 'curve') named_group = curve_group
      if (row%group == model_group .and. row%name == 'state') named_group = load_state_group
      if (named_group > size(group_names)) named_group = 0      ! a vector or a side
   end function named_group

   !> The name that a key accepts in every deck, in addition to the names of the items of the deck; '' for other keys.
   pure function built_in_name(row) result(name)
      type(key_t), intent(in) :: row        !! row of the key in the table of keys
      character(12) :: name

      name = ''
      if (row%role == body_group) name = 'chassis'
      if (row%group == case_group .and. row%name == 'drive') name = 'wheel_travel'
   end function built_in_name

end module ek_choices
