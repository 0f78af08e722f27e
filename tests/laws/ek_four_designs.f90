!> Four designs of a deck on the rig of one of its cases, which differ in their bushings: the members of a pack.
module ek_four_designs
   use ek_kinds, only: wp
   use ek_error, only: error_t, fail, exit_usage
   use ek_deck, only: deck_t, read_deck
   use ek_reader, only: build_model
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t
   use ek_element, only: bushing_element
   use ek_elastic, only: set_bushing_axes
   use ek_kkt, only: kkt_t, new_kkt
   use ek_balance, only: balance
   use ek_path, only: path_t, new_path
   use ek_rig, only: mount
   use ek_lanes, only: lanes
   use ek_pack, only: new_pack
   use ek_walker, only: walker_t, member_t
   use ek_pack_walk, only: walk_pack
   implicit none(type, external)
   private
   public :: design_t, four_designs, members_of, walk_designs, walk_with

   type :: design_t
      type(suspension_t) :: suspension
      type(case_t) :: case
      type(kkt_t) :: kkt
      type(path_t) :: path
   end type design_t

contains

   !> Makes the designs; bushings of design l are stiffer by 5 % × (l − 1). `trouble` is '' if the deck has such a case.
   subroutine four_designs(file, number, designs, trouble, increments)
      character(*), intent(in) :: file
      integer, intent(in) :: number                        !! index of the case
      type(design_t), intent(out) :: designs(lanes)
      character(:), allocatable, intent(out) :: trouble
      integer, intent(in), optional :: increments          !! usually 60
      type(deck_t) :: deck
      type(suspension_t) :: base, changed
      type(case_t), allocatable :: cases(:)
      type(error_t), allocatable :: error
      integer :: l, k

      call read_deck(trim(file), deck, error)
      if (.not. allocated(error)) call build_model(deck, base, cases, error)
      if (.not. allocated(error)) then
         if (number > size(cases)) call fail(error, exit_usage, trim(file)//' has no such case')
      end if
      trouble = ''
      do l = 1, lanes
         if (allocated(error)) exit
         cases(number)%increments = 60
         if (present(increments)) cases(number)%increments = increments
         changed = base
         do k = 1, size(changed%elements)
            if (changed%elements(k)%kind /= bushing_element) cycle
            changed%elements(k)%bushing%kt = changed%elements(k)%bushing%kt*(1.0_wp + 0.05_wp*(l - 1))
            call set_bushing_axes(changed%elements(k)%bushing)
         end do
         call balance(changed, cases(number)%tolerance, error)
         if (allocated(error)) exit
         call mount(changed, cases(number), designs(l)%suspension, designs(l)%case)
         designs(l)%kkt = new_kkt(designs(l)%suspension, wants_plan=.true.)
         call new_path(designs(l)%suspension, designs(l)%case, designs(l)%path)
      end do
      if (allocated(error)) trouble = error%message
   end subroutine four_designs

   !> The members of a pack, which point to their designs.
   subroutine members_of(designs, members)
      type(design_t), intent(inout), target :: designs(lanes)
      type(member_t), intent(out) :: members(lanes)
      integer :: l

      do l = 1, lanes
         members(l)%suspension => designs(l)%suspension
         members(l)%case => designs(l)%case
         members(l)%kkt => designs(l)%kkt
         members(l)%path => designs(l)%path
      end do
   end subroutine members_of

   !> Walks four designs with a new walker.
   subroutine walk_designs(designs, walker, is_walked)
      type(design_t), intent(inout), target :: designs(lanes)
      type(walker_t), intent(out) :: walker
      logical, intent(out) :: is_walked(lanes)

      call new_pack(designs(1)%suspension, designs(1)%kkt, designs(1)%path, walker%pack)
      call walk_with(designs, walker, is_walked)
   end subroutine walk_designs

   !> Walks four designs with a walker that has their pack and may have walked others.
   subroutine walk_with(designs, walker, is_walked)
      type(design_t), intent(inout), target :: designs(lanes)
      type(walker_t), intent(inout) :: walker
      logical, intent(out) :: is_walked(lanes)
      type(member_t) :: members(lanes)

      call members_of(designs, members)
      call walk_pack(walker, members)
      is_walked = members%is_walked
   end subroutine walk_with

end module ek_four_designs
