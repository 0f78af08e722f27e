!> Man pages (man(7)) of the program and of its commands, from the tables of commands and options.
module ek_man_page
   use ek_version, only: version
   use ek_buffer, only: buffer_t
   use ek_clock, only: date_text
   use ek_command_line, only: command_t, option_t, option_name
   use ek_option_help, only: belongs, value_name, description, on_one_line
   implicit none(type, external)
   private
   public :: main_page, command_page

   character(*), parameter :: nl = new_line('a'), backslash = achar(92), alternative = '   or   elastokin '

contains

   !> The man page elastokin(1): purpose of the program, commands, options that every command accepts, exit status.
   function main_page(commands, options, exit_status) result(text)
      type(command_t), intent(in) :: commands(:)
      type(option_t), intent(in) :: options(:)
      character(*), intent(in) :: exit_status             !! section on the exit status of all commands
      character(:), allocatable :: text
      type(buffer_t) :: page
      integer :: k

      call begin_page(page, 'elastokin', 'elastokinematics (kinematics and compliance) of vehicle suspensions')
      call page%line('.B elastokin'//nl//'.I COMMAND FILE'//nl//'.RI [ options ]'//nl//'.SH DESCRIPTION')
      call page%line('Computes the kinematics and compliance of the suspension of a vehicle axle from a deck: a text file of')
      call page%line('Fortran namelist groups that lists hardpoints, bodies, joints, bushings, springs, bump stops and load cases.')
      call page%line('Results are CSV files, JSON files and HTML pages. Their paths are printed to standard output. Messages are')
      call page%line('printed to standard error.'//nl//'.SH COMMANDS')
      do k = 1, size(commands)
         call page%line('.TP'//nl//'.BR elastokin'//roff('-')//trim(commands(k)%name)//' (1)')
         call page%line(roff(trim(commands(k)%summary)))
      end do
      call page%line('.SH OPTIONS'//nl//'Every command accepts these options, and the options on the page of the command.')
      call add_options(page, '', options)
      call page%line('.SH "EXIT STATUS"'//nl//roff(on_one_line(exit_status(index(exit_status, ':') + 1:))))
      call page%line('.SH "SEE ALSO"')
      do k = 1, size(commands)
         call page%line('.BR elastokin'//roff('-')//trim(commands(k)%name)//' (1)'//merge(',', ' ', k < size(commands)))
      end do
      text = page%text()
   end function main_page

   !> The man page of a command in roff, such as elastokin-run(1).
   function command_page(command, options) result(text)
      type(command_t), intent(in) :: command
      type(option_t), intent(in) :: options(:)
      character(:), allocatable :: text
      character(:), allocatable :: usage, ending
      type(buffer_t) :: page
      integer :: cut

      call begin_page(page, 'elastokin-'//trim(command%name), trim(command%summary))
      usage = trim(command%usage)
      cut = index(usage, alternative)
      do while (cut > 0)
         call add_usage(page, usage(:cut - 1))
         call page%line('.br')
         usage = usage(cut + len(alternative):)
         cut = index(usage, alternative)
      end do
      call add_usage(page, usage)
      call page%line('.SH DESCRIPTION'//nl//roff(on_one_line(command%text)))
      call page%line('.SH OPTIONS')
      call add_options(page, trim(command%name), options)
      ending = on_one_line(command%ending)
      if (index(ending, 'Exit status') == 1) then
         call page%line('.SH "EXIT STATUS"'//nl//roff(ending))
      else if (len(ending) > 0) then
         call page%line('.SH NOTES'//nl//roff(ending))
      end if
      call page%line('.SH "SEE ALSO"'//nl//'.BR elastokin (1)')
      text = page%text()
   end function command_page

   !> Begins a page with title, name and the heading of the synopsis.
   subroutine begin_page(page, name, summary)
      type(buffer_t), intent(inout) :: page
      character(*), intent(in) :: name, summary
      character(:), allocatable :: date

      date = date_text()
      call page%line('.TH '//upper(name)//' 1 '//date(:10)//' "elastokin '//version//'" "elastokin manual"')
      call page%line('.nh'//nl//'.ad l')                     ! names and examples are not divided
      call page%line('.SH NAME'//nl//roff(name)//' '//backslash//'- '//roff(summary)//nl//'.SH SYNOPSIS')
   end subroutine begin_page

   !> Adds a line of the synopsis: 'run DECK [options]'.
   subroutine add_usage(page, usage)
      type(buffer_t), intent(inout) :: page
      character(*), intent(in) :: usage

      call page%line('.B elastokin '//usage(:index(usage//' ', ' ') - 1))
      call page%line(roff(adjustl(usage(index(usage//' ', ' '):))))
      if (index(usage, '[options]') == 0) call page%line('[options]')
   end subroutine add_usage

   !> Adds the options of a command; the options that every command accepts are last. For the command '', only these options are
   !> added.
   subroutine add_options(page, command, options)
      type(buffer_t), intent(inout) :: page
      character(*), intent(in) :: command
      type(option_t), intent(in) :: options(:)
      character(:), allocatable :: head
      integer :: k

      do k = 1, size(options)
         if (.not. belongs(options(k), command)) cycle
         head = '.BI '//roff(trim(option_name(options(k))))
         if (value_name(options(k)) /= '') head = head//' " '//value_name(options(k))//'"'
         if (value_name(options(k)) == '') head = '.B '//head(5:)
         call page%line('.TP'//nl//head//nl//roff(description(options, k)))
      end do
   end subroutine add_options

   !> A string as roff source. Line ends become breaks. Backslashes, hyphens, the ellipsis, and dots and apostrophes at the
   !> beginning of lines are escaped.
   pure function roff(text) result(source)
      character(*), intent(in) :: text
      character(:), allocatable :: source
      character(*), parameter :: ellipsis = char(226)//char(128)//char(166)      ! in UTF-8
      integer :: k

      source = ''
      k = 1
      do while (k <= len(text))
         select case (text(k:k))
         case ('-')
            source = source//backslash//'-'
         case (backslash)
            source = source//backslash//'e'
         case (nl)
            source = source//nl//'.br'//nl
         case ('.', '''')
            if (source == '') then
               source = backslash//'&'
            else if (source(len(source):) == nl) then
               source = source//backslash//'&'
            end if
            source = source//text(k:k)
         case default
            if (index(text(k:), ellipsis) == 1) then
               source = source//backslash//'&...'
               k = k + 2
            else
               source = source//text(k:k)
            end if
         end select
         k = k + 1
      end do
   end function roff

   pure function upper(name) result(capitals)
      character(*), intent(in) :: name
      character(len(name)) :: capitals
      integer :: k

      capitals = name
      do k = 1, len(name)
         if (name(k:k) >= 'a' .and. name(k:k) <= 'z') capitals(k:k) = achar(iachar(name(k:k)) - 32)
      end do
   end function upper

end module ek_man_page
