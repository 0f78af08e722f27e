!> A page of results as one self-contained HTML file: headings, tables and embedded pictures.
!>
!> No script, font or picture is fetched: the page itself forbids fetching (Content-Security-Policy). The page is laid out for
!> a screen, in one column for a phone (tables scroll in their own box), and for paper (A4). Input strings are escaped here,
!> except HTML (add_markup), SVG and JSON. Style sheet and script are separate files in page/, which the build puts into
!> ek_page_assets.
module ek_page
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_is_nan
   use ek_kinds, only: wp
   use ek_error, only: message_list_t
   use ek_text, only: str
   use ek_base64, only: base64
   use ek_buffer, only: buffer_t
   use ek_html, only: svg_address, escape_html
   use ek_page_assets, only: add_style, add_script, add_live_style, add_live_script, add_turntable_script, add_figure_script
   implicit none(type, external)
   private
   public :: page_t, begin_page, begin_section, add_text, add_warnings, add_facts
   public :: begin_table, add_cell, add_bar, add_group, end_table
   public :: begin_charts, end_charts, add_picture, add_data_picture, add_figure, add_legend, add_markup, page_text
   public :: page_number, set_data, verdict_html

   character(*), parameter :: nl = new_line('a')

   type :: page_t
      private
      type(buffer_t) :: body, contents
      character(:), allocatable :: title
      character(:), allocatable :: data     !! JSON from which the script draws; not allocated: a page without script
      integer :: header = 0                 !! characters of the body before the list of contents
      integer :: table_columns = 0
      integer :: cells = 0                  !! cells of the last row while the row is incomplete, otherwise 0
      logical :: has_section = .false.
      logical :: is_live = .false.          !! the script of the page also changes rates
      logical :: has_turntable = .false.    !! the script of the page also turns the suspension
      logical :: has_figures = .false.      !! the script of the page also draws figures of panels
      logical :: has_charts = .true.        !! the script of the page draws charts
   end type page_t

contains

   !> Begins a page with its title.
   pure subroutine begin_page(page, title, subtitle)
      type(page_t), intent(out) :: page
      character(*), intent(in) :: title, subtitle

      page%title = title
      call page%body%line('<header><h1>'//escape_html(title)//'</h1>')
      if (len(subtitle) > 0) call page%body%line('<p class="subtitle">'//escape_html(subtitle)//'</p>')
      call page%body%line('</header>')
      page%header = page%body%length()
   end subroutine begin_page

   !> Sets the data of a page whose charts are drawn by its script: JSON without '<'.
   pure subroutine set_data(page, json, is_live, has_turntable, has_figures, has_charts)
      type(page_t), intent(inout) :: page
      character(*), intent(in) :: json
      logical, intent(in), optional :: is_live             !! .true.: the data have rates that the reader can change
      logical, intent(in), optional :: has_turntable       !! .true.: the data have the lines and poses of a suspension
      logical, intent(in), optional :: has_figures         !! .true.: the data have figures of panels
      logical, intent(in), optional :: has_charts          !! .false.: the data have no charts of tests

      page%data = json
      if (present(is_live)) page%is_live = is_live
      if (present(has_turntable)) page%has_turntable = has_turntable
      if (present(has_figures)) page%has_figures = has_figures
      if (present(has_charts)) page%has_charts = has_charts
   end subroutine set_data

   !> Adds a line of HTML unchanged. The caller must have escaped every string in it with escape_html.
   pure subroutine add_markup(page, html)
      type(page_t), intent(inout) :: page
      character(*), intent(in) :: html
      if (len(html) > 0) call page%body%line(html)
   end subroutine add_markup

   !> Begins a section and ends the previous section. `id` consists of letters, digits, _ and -.
   pure subroutine begin_section(page, id, title, condition, is_printed)
      type(page_t), intent(inout) :: page
      character(*), intent(in) :: id, title
      character(*), intent(in), optional :: condition      !! string after the title, in a smaller font
      logical, intent(in), optional :: is_printed          !! .false.: of a live page, on the screen alone
      character(:), allocatable :: small, look

      if (page%has_section) call page%body%line('</section>')
      page%has_section = .true.
      small = ''
      if (present(condition)) small = ' <small>'//escape_html(condition)//'</small>'
      look = ''
      if (present(is_printed)) look = trim(merge('                    ', ' class="not-printed"', is_printed))
      call page%body%line('<section id="'//escape_html(id)//'"'//look//'><h2>'//escape_html(title)//small//'</h2>')
      call page%contents%line('<li><a href="#'//escape_html(id)//'">'//escape_html(title)//'</a></li>')
   end subroutine begin_section

   !> Adds a plain string as a paragraph 'p', as a heading 'h3' within a section, or as preformatted lines 'pre'. HTML markup
   !> in the string is escaped.
   pure subroutine add_text(page, tag, text)
      type(page_t), intent(inout) :: page
      character(*), intent(in) :: tag, text
      character(:), allocatable :: open

      open = tag
      if (tag == 'pre') open = tag//' tabindex="0"'      ! it scrolls
      call page%body%line('<'//open//'>'//escape_html(text)//'</'//tag//'>')
   end subroutine add_text

   !> Adds a box of warnings; adds nothing for an empty list.
   pure subroutine add_warnings(page, title, list)
      type(page_t), intent(inout) :: page
      character(*), intent(in) :: title
      type(message_list_t), intent(in) :: list
      integer :: k

      if (list%count() == 0) return
      call page%body%line('<div class="warning" role="note"><strong>'//escape_html(title)//'</strong><ul>')
      do k = 1, list%count()
         call page%body%line('<li>'//lines_html(list%line(k))//'</li>')
      end do
      call page%body%line('</ul></div>')
   end subroutine add_warnings

   !> A message as HTML, with a line break for each line break of the message.
   pure function lines_html(text) result(html)
      character(*), intent(in) :: text
      character(:), allocatable :: html
      integer :: first, length

      html = ''
      first = 1
      do
         length = index(text(first:)//new_line('a'), new_line('a')) - 1
         html = html//escape_html(text(first:first + length - 1))
         first = first + length + 1
         if (first > len(text)) exit
         html = html//'<br>'
      end do
   end function lines_html

   !> Adds a list of facts, given as names and values; both lists have the same length.
   pure subroutine add_facts(page, names, values)
      type(page_t), intent(inout) :: page
      type(message_list_t), intent(in) :: names, values
      integer :: k

      call page%body%line('<dl>')
      do k = 1, names%count()
         call page%body%line('<div><dt>'//escape_html(names%line(k))//'</dt><dd>'//escape_html(values%line(k))//'</dd></div>')
      end do
      call page%body%line('</dl>')
   end subroutine add_facts

   !> Begins a table with its column headings; a heading that begins with '>' marks a column of numbers, aligned right.
   pure subroutine begin_table(page, heads, class)
      type(page_t), intent(inout) :: page
      character(*), intent(in) :: heads(:)
      character(*), intent(in), optional :: class     !! 'numbers': the filter of a live page hides rows
      character(:), allocatable :: look
      integer :: k, first

      page%table_columns = size(heads)
      look = ''
      if (present(class)) look = ' class="'//escape_html(class)//'"'
      call page%body%add('<div class="scroll" tabindex="0"><table'//look//'><thead><tr>')
      do k = 1, size(heads)
         first = merge(2, 1, index(heads(k), '>') == 1)
         call page%body%add('<th scope="col"'//trim(merge(' class="n">', '>          ', first == 2))// &
            escape_html(trim(heads(k) (first:)))//'</th>')
      end do
      call page%body%line('</tr></thead><tbody>')
   end subroutine begin_table

   !> Adds a heading across the table for the rows below it.
   pure subroutine add_group(page, title)
      type(page_t), intent(inout) :: page
      character(*), intent(in) :: title
      call page%body%line('<tr class="group"><th colspan="'//str(page%table_columns)//'" scope="colgroup">'// &
         escape_html(title)//'</th></tr>')
   end subroutine add_group

   !> Adds the next cell: a string, a number (kind 'n'), or a small string ('s'). A row must have as many cells as the table has
   !> headings.
   pure subroutine add_cell(page, text, kind, link, verdict)
      type(page_t), intent(inout) :: page
      character(*), intent(in) :: text
      character(1), intent(in), optional :: kind
      character(*), intent(in), optional :: link       !! id of the target of the link on the page
      character(*), intent(in), optional :: verdict    !! after a string without link: 'inside' is green, others are red

      if (page%cells == 0) call page%body%add('<tr>')
      call page%body%add('<td')
      if (present(kind)) call page%body%add(' class="'//kind//'"')
      if (present(link)) then
         call page%body%add('><a href="#'//escape_html(link)//'">'//escape_html(text)//'</a></td>')
      else
         call page%body%add('>'//escape_html(text))
         if (present(verdict)) call page%body%add(verdict_html(verdict))
         call page%body%add('</td>')
      end if
      page%cells = modulo(page%cells + 1, page%table_columns)
      if (page%cells == 0) call page%body%line('</tr>')
   end subroutine add_cell

   !> A verdict as HTML, by word and colour; '' without a verdict.
   pure function verdict_html(verdict) result(html)
      character(*), intent(in) :: verdict
      character(:), allocatable :: html, class

      html = ''
      if (verdict == '') return
      class = 'outside'
      if (verdict == 'inside') class = 'inside'
      if (verdict == 'at the edge') class = 'edge'
      html = ' <span class="target '//class//'">'//escape_html(verdict)//'</span>'
   end function verdict_html

   !> Adds the next cell with a bar. The bar begins in the middle and extends to the right; for a negative share, to the left.
   pure subroutine add_bar(page, share)
      type(page_t), intent(inout) :: page
      real(wp), intent(in) :: share              !! length as a share of the longest bar, -1 to 1
      integer :: length

      length = nint(100.0_wp*max(-1.0_wp, min(1.0_wp, share)))
      if (page%cells == 0) call page%body%add('<tr>')
      call page%body%add('<td><svg viewBox="0 0 200 10" style="width:200px;height:10px" aria-hidden="true"><rect x="'// &
         str(100 + min(length, 0))//'" width="'//str(abs(length))//'" height="10" style="fill:var(--c'// &
         trim(merge('2', '1', length < 0))//')"/></svg></td>')
      page%cells = modulo(page%cells + 1, page%table_columns)
      if (page%cells == 0) call page%body%line('</tr>')
   end subroutine add_bar

   !> Ends a table.
   pure subroutine end_table(page)
      type(page_t), intent(inout) :: page
      call page%body%line('</tbody></table></div>')
   end subroutine end_table

   !> Begins a block of charts. As many charts as fit are side by side.
   pure subroutine begin_charts(page, is_short)
      type(page_t), intent(inout) :: page
      logical, intent(in), optional :: is_short     !! .true.: of a live page only the first three are printed
      logical :: is_few

      is_few = .false.
      if (present(is_short)) is_few = is_short
      call page%body%line('<div class="charts'//trim(merge(' few">', '">    ', is_few)))
   end subroutine begin_charts

   !> Ends a block of charts.
   pure subroutine end_charts(page)
      type(page_t), intent(inout) :: page
      call page%body%line('</div>')
   end subroutine end_charts

   !> Adds an SVG picture drawn by gnuplot: at full width if `caption` is present, otherwise as one chart of a block.
   pure subroutine add_picture(page, svg, title, caption)
      type(page_t), intent(inout) :: page
      character(*), intent(in) :: svg, title     !! content of the file; its description
      character(*), intent(in), optional :: caption

      call page%body%add(trim(merge('<figure class="drawn wide">', '<figure class="drawn">     ', present(caption))))
      call page%body%add('<img alt="'//escape_html(title)//'" src="')
      call page%body%add(svg_address(svg))
      call page%body%add('">')
      if (present(caption)) call page%body%add('<figcaption>'//escape_html(caption)//'</figcaption>')
      call page%body%line('</figure>')
   end subroutine add_picture

   !> Adds the place of a figure of panels, which the script of the page draws.
   pure subroutine add_figure(page, name, caption)
      type(page_t), intent(inout) :: page
      character(*), intent(in) :: name, caption  !! name of the figure in the data of the page; caption below it

      call page%body%line('<figure class="wide" id="figure-'//escape_html(name)//'"><noscript><p>The script of this page draws '// &
         'this figure.</p></noscript><figcaption>'//escape_html(caption)//'</figcaption></figure>')
   end subroutine add_figure

   !> Adds a raster picture (GIF, PNG) embedded in the page as base64.
   pure subroutine add_data_picture(page, bytes, kind, title, caption)
      type(page_t), intent(inout) :: page
      character(*), intent(in) :: bytes          !! content of the file
      character(*), intent(in) :: kind           !! 'gif' or 'png'
      character(*), intent(in) :: title, caption

      call page%body%add('<figure class="drawn wide"><img alt="'//escape_html(title)//'" src="data:image/'//kind//';base64,')
      call page%body%add(base64(bytes))
      call page%body%add('">')
      if (len(caption) > 0) call page%body%add('<figcaption>'//escape_html(caption)//'</figcaption>')
      call page%body%line('</figure>')
   end subroutine add_data_picture

   !> Adds a legend for the charts that follow. The names are in the order of the palette. From the second name on, lines are dashed
   !> (or points are rings).
   pure subroutine add_legend(page, names, has_design, has_points)
      type(page_t), intent(inout) :: page
      character(*), intent(in) :: names(:)
      logical, intent(in) :: has_design
      logical, intent(in) :: has_points          !! the charts have points without lines
      character(:), allocatable :: colour
      integer :: k

      call page%body%add('<p class="legend">')
      do k = 1, size(names)
         colour = 'var(--c'//str(modulo(k - 1, 8) + 1)//')'
         if (has_points) then
            call page%body%add('<span><b style="border-color:'//colour)
            if (k == 1) call page%body%add(';background:'//colour)
            call page%body%add('"></b>')
         else
            call page%body%add('<span><i style="border-top:3px '//trim(merge('dashed', 'solid ', k > 1))//' '//colour//'"></i>')
         end if
         call page%body%add(escape_html(trim(names(k)))//'</span>')
      end do
      if (has_design) call page%body%add('<span><b></b>design</span>')
      call page%body%line('</p>')
   end subroutine add_legend

   !> The complete HTML of the page.
   pure function page_text(page) result(text)
      type(page_t), intent(in) :: page
      character(:), allocatable :: text
      type(buffer_t) :: head, tail
      character(:), allocatable :: contents
      integer :: before, behind

      call head%line('<!doctype html>')
      call head%line('<html lang="en"><head><meta charset="utf-8">')
      call head%line('<meta name="viewport" content="width=device-width, initial-scale=1">')
      call head%add('<meta http-equiv="Content-Security-Policy" content="default-src ''none''; img-src data:; style-src '// &
         '''unsafe-inline''')
      if (allocated(page%data)) call head%add('; script-src ''unsafe-inline''')
      call head%line('">')
      ! without an icon in the page a browser requests /favicon.ico
      call head%line('<link rel="icon" href="data:,">')
      call head%line('<title>'//escape_html(page%title)//'</title>')
      call head%line('<style>')
      call add_style(head)
      if (page%is_live) call add_live_style(head)
      call head%line('</style></head><body'// &
         trim(merge(' class="is-live">', '>                ', allocated(page%data) .and. page%has_charts))//'<main>')
      contents = ''
      if (page%contents%length() > 0) contents = '<nav aria-label="Contents"><ul>'//page%contents%text()// &
         '<li><a href="#top">Back to top</a></li></ul></nav>'
      if (page%has_section) call tail%line('</section>')
      call tail%line('</main>')
      if (allocated(page%data)) then
         call tail%add('<script type="application/json" id="data">')
         call tail%add(page%data)
         call tail%line('</script>')
         call tail%line('<script type="module">')
         call add_script(tail)
         if (page%has_figures) call add_figure_script(tail)
         if (page%has_turntable) call add_turntable_script(tail)
         if (page%is_live) call add_live_script(tail)
         call tail%line('</script>')
      end if
      call tail%line('</body></html>')

      ! the pictures in the body are megabytes: each piece is copied once
      before = head%length() + page%header
      behind = before + len(contents) + page%body%length() - page%header
      allocate (character(behind + tail%length()) :: text)
      call head%copy(1, text(:head%length()))
      call page%body%copy(1, text(head%length() + 1:before))
      text(before + 1:before + len(contents)) = contents
      call page%body%copy(page%header + 1, text(before + len(contents) + 1:behind))
      call tail%copy(1, text(behind + 1:))
   end function page_text

   !> A number for a table: four digits, with at most four decimals; below 1e7, all digits before the decimal point. From 1e7
   !> on, it has an exponent. '–' for NaN, and '∞' or '−∞' for an infinite number.
   pure function page_number(value) result(text)
      real(wp), intent(in) :: value
      character(:), allocatable :: text
      character(32) :: buffer
      character(8) :: form

      text = '–'
      if (ieee_is_nan(value)) return
      text = '∞'
      if (value < 0.0_wp) text = '−∞'
      if (.not. ieee_is_finite(value)) return
      if (abs(value) >= 1.0e7_wp) then
         text = str(value, 4)
      else
         write (form, '(a,i0,a)') '(f32.', 4 - count(abs(value) >= [1.0_wp, 10.0_wp, 100.0_wp, 1000.0_wp]), ')'
         write (buffer, form) value
         text = trim(adjustl(buffer))
         if (verify(text, '-0.') == 0) text = '0'
         if (index(text, '.') == 1) text = '0'//text
         if (index(text, '-.') == 1) text = '-0'//text(2:)
         if (text(len(text):) == '.') text = text(:len(text) - 1)
      end if
      if (index(text, '-') == 1) text = '−'//text(2:)
   end function page_number

end module ek_page
