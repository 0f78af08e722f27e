!> The camera of a scene: direction of view, scale, and the position of a point in the picture.
!>
!> The camera has the two angles [deg] of gnuplot's `set view`. At turn = 0 the view is from the left of the car to the right; at
!> turn = 270, from the front rearward.
module ek_camera
   use ek_kinds, only: wp, degree
   use ek_scene, only: scene_t, run_t
   implicit none(type, external)
   private
   public :: camera_t, fit_camera, projection_t, new_projection, in_picture

   ! measured with gnuplot 5.4, font sizes 12 to 13
   real(wp), parameter :: box_share = 0.507_wp       ! longest edge of the box, in shorter sides of the picture
   real(wp), parameter :: above_middle = 0.014_wp    ! offset of the centre in picture heights

   !> Direction of view, centre and scale of a camera, and the size of its picture.
   type :: camera_t
      real(wp) :: tilt = 68.0_wp, turn = 300.0_wp       !! angles of `set view` [deg]
      real(wp) :: centre(3) = 0.0_wp                    !! point at the middle of the picture [m]
      real(wp) :: span = 1.0_wp                         !! edge of the cube of the axis ranges [m]
      real(wp) :: zoom = 1.0_wp                         !! third number of `set view`
      real(wp) :: width = 3.0_wp, height = 2.0_wp       !! size of the picture, in any unit
      real(wp) :: scale = 1.0_wp                        !! length in the picture per m, in the unit of width and height
   end type camera_t

   !> Transformation from a point in space to its position in the picture.
   type :: projection_t
      real(wp) :: matrix(2, 3) = 0.0_wp, centre(3) = 0.0_wp
   end type projection_t

contains

   !> Finds unit vectors to the right and upward in the picture.
   pure subroutine directions(camera, right, up)
      type(camera_t), intent(in) :: camera
      real(wp), intent(out) :: right(3), up(3)

      right = [cos(camera%turn*degree), sin(camera%turn*degree), 0.0_wp]
      up = [-sin(camera%turn*degree)*cos(camera%tilt*degree), cos(camera%turn*degree)*cos(camera%tilt*degree), &
         sin(camera%tilt*degree)]
   end subroutine directions

   !> The projection of a fitted camera onto its picture, as shares of width and height.
   pure type(projection_t) function new_projection(camera) result(self)
      type(camera_t), intent(in) :: camera      !! fitted
      real(wp) :: right(3), up(3)

      call directions(camera, right, up)
      self%matrix(1, :) = right*camera%scale/camera%width
      self%matrix(2, :) = up*camera%scale/camera%height
      self%centre = camera%centre
   end function new_projection

   !> The position of a point in the picture: share of the width from the left, and share of the height from below [-].
   pure function in_picture(self, at) result(place)
      type(projection_t), intent(in) :: self
      real(wp), intent(in) :: at(3)      !! m
      real(wp) :: place(2)
      place = matmul(self%matrix, at - self%centre) + [0.5_wp, 0.5_wp + above_middle]
   end function in_picture

   !> Fits a camera to some scenes: sets its centre, span, zoom and scale so that all faces and lines of the scenes fill a
   !> picture of the given size. If the scenes are empty, only the span and the size of the picture are set. The longest edge
   !> of gnuplot's box is a fixed share of the shorter side of the picture, times the zoom.
   subroutine fit_camera(camera, scenes, width, height, footer)
      type(camera_t), intent(inout) :: camera     !! tilt and turn are input
      type(scene_t), intent(in) :: scenes(:)
      real(wp), intent(in) :: width, height       !! size of the picture, any unit
      real(wp), intent(in) :: footer              !! share of the height that is left free below
      real(wp), allocatable :: at(:, :), across(:), upward(:)
      real(wp) :: right(3), up(3), scale
      integer :: s, k, n

      call directions(camera, right, up)
      allocate (at(3, sum(scenes%faces%used) + sum(scenes%lines%used)))
      n = 0
      do s = 1, size(scenes)
         call include(scenes(s)%faces)
         call include(scenes(s)%lines)
      end do
      camera%span = 0.1_wp
      camera%width = width
      camera%height = height
      if (n == 0) return
      across = [(dot_product(right, at(:, k)), k=1, n)]
      upward = [(dot_product(up, at(:, k)), k=1, n)]
      scale = 0.95_wp*min(width/max(maxval(across) - minval(across), 1.0e-3_wp), &
         height*(1 - footer)/max(maxval(upward) - minval(upward), 1.0e-3_wp))
      camera%centre = right*((minval(across) + maxval(across))/2) + &
         up*((minval(upward) + maxval(upward))/2 - (footer/2 - above_middle)*height/scale)
      ! the box must contain every vertex; gnuplot clips at the box
      camera%span = max(camera%span, 2.1_wp*maxval([(maxval(abs(at(:, k) - camera%centre)), k=1, n)]))
      camera%zoom = scale*camera%span/(box_share*min(width, height))
      camera%scale = scale

   contains

      subroutine include(list)
         type(run_t), intent(in) :: list
         if (list%used > 0) at(:, n + 1:n + list%used) = list%at(:, :list%used)
         n = n + list%used
      end subroutine include

   end subroutine fit_camera

end module ek_camera
