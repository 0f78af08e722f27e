!> The designs of a study in packs. The numbers of the designs are set one design after the other. The paths of all designs of a
!> pack are followed together.
!>
!> The plan of elimination, the scale and the swept values of the states come from the deck's own design. The result of a design
!> therefore does not depend on the other designs of the pack. The designs are solved one by one in a case that packs cannot solve:
!> linear methods, `follow = 'arc'`, tables, and paths that do not pass through design. They are also solved one by one with LAPACK
!> as solver, and in builds by compilers whose lanes are slow.
module ek_study_pack
   use, intrinsic :: iso_fortran_env, only: compiler_version
   use ek_lanes, only: lanes
   use ek_pack, only: new_pack
   use ek_pack_walk, only: walker_t, member_t, walk_pack, can_walk
   use ek_path_states, only: new_path
   use ek_workspace, only: workspace_t
   implicit none(type, external)
   private
   public :: pack_space_t, begin_packs, walk_case, lanes, are_lanes_fast

   !> Whether lanes are fast. gfortran compiles lanes to vector instructions, but flang calls its run-time library for lanes.
   logical, parameter :: are_lanes_fast = index(compiler_version(), 'GCC') > 0

   !> Work space of one thread for packs.
   type :: pack_space_t
      ! classes for the reason given at case_work_t
      class(workspace_t), allocatable :: workspaces(:)     !! workspaces of all designs of a pack except the first design, which
                                                           !! uses the workspace of the study
      class(walker_t), allocatable :: walkers(:)     !! one per case
      logical, allocatable :: is_used(:)             !! whether packs walk each case
   end type pack_space_t

contains

   !> Prepares packs for the cases of a workspace. The cases must have been solved.
   subroutine begin_packs(workspace, space)
      type(workspace_t), intent(in) :: workspace
      type(pack_space_t), intent(out) :: space
      integer :: c

      allocate (space%walkers(size(workspace%cases)), space%is_used(size(workspace%cases)))
      do c = 1, size(workspace%cases)
         associate (result => workspace%cases(c)%result)
            space%is_used(c) = are_lanes_fast .and. result%kkt%has_plan .and. can_walk(result%case, result%path)
            if (space%is_used(c)) call new_pack(result%suspension, result%kkt, result%path, space%walkers(c)%pack)
         end associate
      end do
      allocate (space%workspaces(merge(lanes - 1, 0, any(space%is_used))), source=workspace)
   end subroutine begin_packs

   !> Solves case c of several designs together. is_walked is .true. for each design whose path is complete. If packs do not walk
   !> the case, is_walked is .false. for all designs.
   subroutine walk_case(c, workspace, is_wanted, space, is_walked)
      integer, intent(in) :: c
      type(workspace_t), intent(inout), target :: workspace        !! workspace of the first design
      logical, intent(in) :: is_wanted(lanes) !! the case of the design is on the rig; .false. also if there is no such design
      type(pack_space_t), intent(inout), target :: space     !! work space with the workspaces of the other designs
      logical, intent(out) :: is_walked(lanes)
      type(member_t) :: members(lanes)
      integer :: l, filler

      is_walked = .false.
      if (.not. space%is_used(c)) return
      filler = findloc(is_wanted, .true., dim=1)
      do l = 1, lanes
         members(l)%is_wanted = is_wanted(l)
         if (merge(l, filler, is_wanted(l)) == 1) then
            call point_to(workspace, members(l))
         else
            call point_to(space%workspaces(merge(l, filler, is_wanted(l)) - 1), members(l))
         end if
         if (is_wanted(l)) call new_path(members(l)%suspension, members(l)%case, members(l)%path)
      end do
      call walk_pack(space%walkers(c), members)
      is_walked = members%is_walked

   contains

      !> Sets the pointers of a pack member to the data of the case in a workspace.
      subroutine point_to(from, member)
         type(workspace_t), intent(inout), target :: from
         type(member_t), intent(inout) :: member

         member%suspension => from%cases(c)%result%suspension
         member%case => from%cases(c)%result%case
         member%kkt => from%cases(c)%result%kkt
         member%path => from%cases(c)%result%path
      end subroutine point_to

   end subroutine walk_case

end module ek_study_pack
