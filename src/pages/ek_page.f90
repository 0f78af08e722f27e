!> A page of results as one self-contained HTML file. The page contains its sections as data (JSON), from which its script
!> (page/section.js) makes headings, tables, charts and pictures.
!>
!> The same calls write the text of a page for a browser without script: of a static page everything, of other pages the facts, the
!> warnings and the sections with has_text. No script, font or picture is fetched: the page itself forbids fetching
!> (Content-Security-Policy). The page is laid out for a screen, in one column for a phone (tables scroll in their own box), and for
!> paper (A4). Style sheet and script are separate files in page/, which the build puts into ek_page_assets.
module ek_page
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_is_nan
   use ek_kinds, only: wp
   use ek_error, only: message_list_t
   use ek_text, only: str
   use ek_base64, only: base64
   use ek_buffer, only: buffer_t
   use ek_html, only: svg_address, escape_html
   use ek_json, only: json_t, json_string, json_strings, without_tags
   use ek_letters, only: as_utf8
   use ek_page_assets, only: add_style, add_script, add_live_style, add_live_script, add_turntable_script, add_figure_script
   implicit none(type, external)
   private
   public :: page_t, begin_page, begin_section, add_text, add_file, add_warnings, add_facts, put_fact, begin_fold, end_fold
   public :: write_as_text, write_as_data, end_text, begin_beside, end_beside
   public :: begin_table, add_cell, add_numbers, add_bar, add_group, end_table
   public :: add_charts, begin_pictures, end_pictures, add_picture, add_data_picture, add_figure, add_legend, add_block, page_text
   public :: page_number, set_data

   type :: page_t
      private
      type(buffer_t) :: body, contents      !! text without script; list of its sections
      type(json_t) :: sections              !! data of the sections
      character(:), allocatable :: title, subtitle
      character(:), allocatable :: data     !! JSON from which the script draws; not allocated: a page without charts
      integer :: table_columns = 0
      integer :: cells = 0                  !! cells of the last row while the row is incomplete, otherwise 0
      character(:), allocatable :: kinds    !! kind of each column of the table: 'n' numbers, 's' small print, ' '
      logical :: is_static = .false.        !! a page without script
      logical :: has_text = .true.          !! the section is also text without script
      logical :: has_data = .true.          !! the section is data
      logical :: has_section = .false.      !! the text has a section
      logical :: is_live = .false.          !! the script of the page also changes rates
      logical :: has_turntable = .false.    !! the script of the page also turns the suspension
      logical :: has_figures = .false.      !! the script of the page also draws figures of panels
      logical :: has_charts = .true.        !! the script of the page draws charts
   end type page_t

contains

   !> Begins a page with its title.
   pure subroutine begin_page(page, title, subtitle, is_static)
      type(page_t), intent(out) :: page
      character(*), intent(in) :: title, subtitle
      logical, intent(in), optional :: is_static           !! .true.: a page without script

      page%title = title
      page%subtitle = subtitle
      if (present(is_static)) page%is_static = is_static
      page%has_data = .not. page%is_static
      page%sections%is_one_line = .true.
      call page%sections%open('[')
      call page%sections%open('{')
      call page%sections%open('[', 'blocks')
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

   !> A string as JSON.
   pure function quoted(text) result(literal)
      character(*), intent(in) :: text
      character(:), allocatable :: literal
      literal = json_string(as_utf8(text))
   end function quoted

   !> Adds a line of text for a browser without script.
   pure subroutine say(page, html)
      type(page_t), intent(inout) :: page
      character(*), intent(in) :: html
      if (page%has_text) call page%body%line(html)
   end subroutine say

   !> Adds a block that the script makes: its kind and its data, and optionally a second item.
   pure subroutine add_block(page, kind, literal, key, second)
      type(page_t), intent(inout) :: page
      character(*), intent(in) :: kind, literal            !! name of the block in section.js; JSON
      character(*), intent(in), optional :: key, second    !! name of the second item; JSON

      if (.not. page%has_data) return
      call page%sections%open('{')
      call page%sections%item(kind, literal)
      if (present(key)) call page%sections%item(key, second)
      call page%sections%close('}')
   end subroutine add_block

   !> Writes the blocks that follow only as text, or again as data, too.
   pure subroutine write_as_text(page, is_only)
      type(page_t), intent(inout) :: page
      logical, intent(in) :: is_only
      page%has_data = .not. (page%is_static .or. is_only)
   end subroutine write_as_text

   !> Writes the blocks that follow only as data, or again as text, too, within a section that is also text. A static page is text to
   !> its end.
   pure subroutine write_as_data(page, is_only)
      type(page_t), intent(inout) :: page
      logical, intent(in) :: is_only
      page%has_text = page%is_static .or. .not. is_only
   end subroutine write_as_data

   !> Ends the text for browsers without script within a section; what follows is only data. A static page is text to its end.
   pure subroutine end_text(page)
      type(page_t), intent(inout) :: page
      page%has_text = page%is_static
   end subroutine end_text

   !> Begins a section and ends the previous section. `id` consists of letters, digits, _ and -.
   pure subroutine begin_section(page, id, title, condition, is_printed, has_text)
      type(page_t), intent(inout) :: page
      character(*), intent(in) :: id, title
      character(*), intent(in), optional :: condition      !! string after the title, in a smaller font
      logical, intent(in), optional :: is_printed          !! .false.: of a live page, on the screen alone
      logical, intent(in), optional :: has_text            !! .true.: also for browsers without script
      character(:), allocatable :: small, name

      small = ''
      if (present(condition)) small = condition
      call page%sections%close(']')
      call page%sections%close('}')
      call page%sections%open('{')
      call page%sections%item('id', quoted(id))
      call page%sections%item('title', quoted(title))
      if (small /= '') call page%sections%item('condition', quoted(small))
      if (present(is_printed)) call page%sections%item('printed', trim(merge('true ', 'false', is_printed)))
      call page%sections%open('[', 'blocks')
      page%has_text = page%is_static
      if (present(has_text)) page%has_text = page%is_static .or. has_text
      if (.not. page%has_text) return
      if (page%has_section) call say(page, '</section>')
      page%has_section = .true.
      if (small /= '') small = ' <small>'//escape_html(small)//'</small>'
      name = ''
      if (page%is_static) name = ' id="'//escape_html(id)//'"'        ! otherwise the script gives it
      call say(page, '<section'//name//'><h2>'//escape_html(title)//small//'</h2>')
      if (page%is_static) call page%contents%line('<li><a href="#'//escape_html(id)//'">'//escape_html(title)//'</a></li>')
   end subroutine begin_section

   !> Adds a plain string as a paragraph 'p', as a heading 'h3' within a section, as preformatted lines 'pre', or as a verdict 'b'.
   pure subroutine add_text(page, tag, text)
      type(page_t), intent(inout) :: page
      character(*), intent(in) :: tag, text

      call add_block(page, tag, quoted(text))
      if (tag == 'b') call say(page, '<p class="verdict"><b>'//escape_html(text)//'</b></p>')
      if (tag /= 'b') call say(page, '<'//tag//'>'//escape_html(text)//'</'//tag//'>')
   end subroutine add_text

   !> Adds a paragraph with a link to a file at its end.
   pure subroutine add_file(page, text, file)
      type(page_t), intent(inout) :: page
      character(*), intent(in) :: text, file     !! file: relative to the page

      call add_block(page, 'p', quoted(text), 'file', quoted(file))
      call say(page, '<p>'//escape_html(text)//'<a href="'//escape_html(file)//'">'//escape_html(file)//'</a></p>')
   end subroutine add_file

   !> Adds a box of warnings; adds nothing for an empty list.
   pure subroutine add_warnings(page, title, list)
      type(page_t), intent(inout) :: page
      character(*), intent(in) :: title
      type(message_list_t), intent(in) :: list
      integer :: k

      if (list%count() == 0) return
      call add_block(page, 'warnings', json_strings(list), 'title', quoted(title))
      call say(page, '<div class="warning" role="note"><strong>'//escape_html(title)//'</strong><ul>')
      do k = 1, list%count()
         call say(page, '<li>'//escape_html(list%line(k))//'</li>')
      end do
      call say(page, '</ul></div>')
   end subroutine add_warnings

   !> Adds a list of facts, given as names and values; all lists have the same length.
   pure subroutine add_facts(page, names, values, marks)
      type(page_t), intent(inout) :: page
      type(message_list_t), intent(in) :: names, values
      type(message_list_t), intent(in), optional :: marks  !! the facts are verdicts: 'inside', 'outside' or '' for each
      character(:), allocatable :: mark, rows
      integer :: k

      rows = ''
      call say(page, '<dl'//trim(merge(' class="verdicts">', '>                 ', present(marks))))
      do k = 1, names%count()
         mark = ''
         if (present(marks)) mark = marks%line(k)
         if (k > 1) rows = rows//', '
         rows = rows//'['//quoted(names%line(k))//', '//quoted(values%line(k))
         if (mark /= '') rows = rows//', '//quoted(mark)
         rows = rows//']'
         call say(page, '<div><dt>'//escape_html(names%line(k))//'</dt><dd>'//escape_html(values%line(k))//mark_html(mark)// &
            '</dd></div>')
      end do
      call say(page, '</dl>')
      call add_block(page, trim(merge('verdicts', 'facts   ', present(marks))), '['//rows//']')
   end subroutine add_facts

   !> Appends a fact to the lists of add_facts.
   pure subroutine put_fact(names, values, name, value)
      type(message_list_t), intent(inout) :: names, values
      character(*), intent(in) :: name, value

      call names%add(name)
      call values%add(value)
   end subroutine put_fact

   !> Begins a row of two blocks, side by side on a wide screen. The blocks follow until end_beside.
   pure subroutine begin_beside(page)
      type(page_t), intent(inout) :: page

      call say(page, '<div class="beside">')
      if (.not. page%has_data) return
      call page%sections%open('{')
      call page%sections%open('[', 'beside')
   end subroutine begin_beside

   !> Ends a row of two blocks.
   pure subroutine end_beside(page)
      type(page_t), intent(inout) :: page

      call end_blocks(page, '</div>')
   end subroutine end_beside

   !> Ends a block that contains blocks.
   pure subroutine end_blocks(page, tag)
      type(page_t), intent(inout) :: page
      character(*), intent(in) :: tag

      call say(page, tag)
      if (.not. page%has_data) return
      call page%sections%close(']')
      call page%sections%close('}')
   end subroutine end_blocks

   !> Begins a block that a click on its summary opens. Its blocks follow until end_fold.
   pure subroutine begin_fold(page, summary, id)
      type(page_t), intent(inout) :: page
      character(*), intent(in) :: summary
      character(*), intent(in), optional :: id             !! target of links: letters, digits, _ and -
      character(:), allocatable :: name

      name = ''
      if (present(id) .and. page%is_static) name = ' id="'//escape_html(id)//'"'     ! otherwise the script gives it
      call say(page, '<details class="more"'//name//'><summary>'//escape_html(summary)//'</summary>')
      if (.not. page%has_data) return
      call page%sections%open('{')
      call page%sections%item('fold', quoted(summary))
      if (present(id)) call page%sections%item('id', quoted(id))
      call page%sections%open('[', 'blocks')
   end subroutine begin_fold

   !> Ends a block that a click opens.
   pure subroutine end_fold(page)
      type(page_t), intent(inout) :: page

      call end_blocks(page, '</details>')
   end subroutine end_fold

   !> Begins a table with its column headings. A heading that begins with '>' marks a column of numbers, aligned right, and one that
   !> begins with '~' a column of small print.
   pure subroutine begin_table(page, heads, class)
      type(page_t), intent(inout) :: page
      character(*), intent(in) :: heads(:)
      character(*), intent(in), optional :: class     !! 'numbers': the filter of a live page hides rows
      character(:), allocatable :: look
      type(message_list_t) :: list
      integer :: k

      page%table_columns = size(heads)
      page%kinds = repeat(' ', size(heads))
      look = ''
      if (present(class)) look = ' class="'//class//'"'
      look = '<div class="scroll" tabindex="0"><table'//look//'><thead><tr>'
      do k = 1, size(heads)
         if (heads(k) (1:1) == '>') page%kinds(k:k) = 'n'
         if (heads(k) (1:1) == '~') page%kinds(k:k) = 's'
         call list%add(trim(heads(k)))
         look = look//'<th scope="col"'//trim(merge(' class="n">', '>          ', page%kinds(k:k) == 'n'))// &
            escape_html(trim(heads(k) (merge(1, 2, page%kinds(k:k) == ' '):)))//'</th>'
      end do
      call say(page, look//'</tr></thead><tbody>')
      if (.not. page%has_data) return
      call page%sections%open('{')
      if (present(class)) call page%sections%item('look', quoted(class))
      call page%sections%item('heads', json_strings(list))
      call page%sections%open('[', 'table')
   end subroutine begin_table

   !> Adds a heading across the table for the rows below it.
   pure subroutine add_group(page, title)
      type(page_t), intent(inout) :: page
      character(*), intent(in) :: title

      if (page%has_data) call page%sections%item_of_list(quoted(title))
      call say(page, '<tr class="group"><th colspan="'//str(page%table_columns)//'" scope="colgroup">'// &
         escape_html(title)//'</th></tr>')
   end subroutine add_group

   !> Adds the next cell. A row must have as many cells as the table has headings.
   pure subroutine add_cell(page, text, link, verdict, is_small)
      type(page_t), intent(inout) :: page
      character(*), intent(in) :: text
      character(*), intent(in), optional :: link       !! id of the target of the link on the page
      character(*), intent(in), optional :: verdict    !! after the string: 'inside' is green, others are red
      logical, intent(in), optional :: is_small        !! small print in a column of another kind
      character(:), allocatable :: more, mark

      more = ''
      mark = ''
      if (present(link)) more = ', "to": '//quoted(link)
      if (present(verdict)) mark = verdict
      if (mark /= '') more = more//', "mark": '//quoted(mark)
      if (present(is_small)) more = more//', "small": true'
      if (more == '') call put_cell(page, quoted(text), escape_html(text))
      if (more /= '') call put_cell(page, '{"text": '//quoted(text)//more//'}', escape_html(text)//mark_html(mark), is_small)
   end subroutine add_cell

   !> Adds the next cells: numbers.
   pure subroutine add_numbers(page, values)
      type(page_t), intent(inout) :: page
      real(wp), intent(in) :: values(:)
      integer :: k

      do k = 1, size(values)
         call add_cell(page, page_number(values(k)))
      end do
   end subroutine add_numbers

   !> Adds the next cell with a bar, which begins in the middle and extends to the right; for a negative share, to the left.
   pure subroutine add_bar(page, share)
      type(page_t), intent(inout) :: page
      real(wp), intent(in) :: share              !! length as a share of the longest bar, -1 to 1

      call put_cell(page, '{"bar": '//str(nint(100.0_wp*max(-1.0_wp, min(1.0_wp, share))))//'}', '')
   end subroutine add_bar

   !> Adds the next cell as data and as text, and ends a row that is complete.
   pure subroutine put_cell(page, literal, html, is_small)
      type(page_t), intent(inout) :: page
      character(*), intent(in) :: literal, html
      logical, intent(in), optional :: is_small
      character(:), allocatable :: look

      if (page%cells == 0) then
         if (page%has_data) call page%sections%open('[')
         if (page%has_text) call page%body%add('<tr>')
      end if
      page%cells = page%cells + 1
      look = ''
      if (page%kinds(page%cells:page%cells) /= ' ') look = ' class="'//page%kinds(page%cells:page%cells)//'"'
      if (present(is_small)) look = ' class="s"'
      if (page%has_data) call page%sections%item_of_list(literal)
      if (page%has_text) call page%body%add('<td'//look//'>'//html//'</td>')
      if (page%cells < page%table_columns) return
      page%cells = 0
      if (page%has_data) call page%sections%close(']')
      call say(page, '</tr>')
   end subroutine put_cell

   !> A verdict as HTML, by word and colour; '' without a verdict.
   pure function mark_html(verdict) result(html)
      character(*), intent(in) :: verdict
      character(:), allocatable :: html, class

      html = ''
      if (verdict == '') return
      class = 'outside'
      if (verdict == 'inside') class = 'inside'
      if (verdict == 'at the edge') class = 'edge'
      html = ' <span class="target '//class//'">'//escape_html(verdict)//'</span>'
   end function mark_html

   !> Ends a table.
   pure subroutine end_table(page)
      type(page_t), intent(inout) :: page

      call say(page, '</tbody></table></div>')
      if (.not. page%has_data) return
      call page%sections%close(']')
      call page%sections%close('}')
   end subroutine end_table

   !> Adds charts of the data of the page, which the script draws side by side.
   pure subroutine add_charts(page, names, notes, is_first)
      type(page_t), intent(inout) :: page
      type(message_list_t), intent(in) :: names                !! ids of the charts
      type(message_list_t), intent(in), optional :: notes      !! a note on each chart; on paper the page has only the first three
      logical, intent(in), optional :: is_first                !! .true.: charts of the first screen, which link to those of the tests

      if (present(is_first)) then
         if (is_first) call add_block(page, 'charts', json_strings(names), 'first', 'true')
         if (is_first) return
      end if
      if (present(notes)) call add_block(page, 'charts', json_strings(names), 'notes', json_strings(notes))
      if (.not. present(notes)) call add_block(page, 'charts', json_strings(names))
   end subroutine add_charts

   !> Begins pictures of gnuplot on a static page. As many as fit are side by side.
   pure subroutine begin_pictures(page)
      type(page_t), intent(inout) :: page
      call say(page, '<div class="charts">')
   end subroutine begin_pictures

   !> Ends pictures of gnuplot on a static page.
   pure subroutine end_pictures(page)
      type(page_t), intent(inout) :: page
      call say(page, '</div>')
   end subroutine end_pictures

   !> Adds an SVG picture drawn by gnuplot to a static page: at full width if `caption` is present, otherwise as one of several.
   pure subroutine add_picture(page, svg, title, caption)
      type(page_t), intent(inout) :: page
      character(*), intent(in) :: svg, title     !! content of the file; its description
      character(*), intent(in), optional :: caption

      if (present(caption)) call say_picture(page, svg_address(svg), title, ' wide', caption)
      if (.not. present(caption)) call say_picture(page, svg_address(svg), title, '', '')
   end subroutine add_picture

   !> Adds a raster picture (GIF, PNG) embedded in the page as base64.
   pure subroutine add_data_picture(page, bytes, kind, title, caption)
      type(page_t), intent(inout) :: page
      character(*), intent(in) :: bytes          !! content of the file
      character(*), intent(in) :: kind           !! 'gif' or 'png'
      character(*), intent(in) :: title, caption
      character(:), allocatable :: address

      address = 'data:image/'//kind//';base64,'//base64(bytes)
      call add_block(page, 'picture', '"'//address//'"', 'labels', '['//quoted(title)//', '//quoted(caption)//']')
      call say_picture(page, address, title, ' wide', caption)
   end subroutine add_data_picture

   !> Adds a picture to the text.
   pure subroutine say_picture(page, address, title, look, caption)
      type(page_t), intent(inout) :: page
      character(*), intent(in) :: address, title, look, caption

      if (.not. page%has_text) return
      call page%body%add('<figure class="drawn'//look//'"><img alt="'//escape_html(title)//'" src="')
      call page%body%add(address)
      call page%body%add('">')
      if (len(caption) > 0) call page%body%add('<figcaption>'//escape_html(caption)//'</figcaption>')
      call page%body%line('</figure>')
   end subroutine say_picture

   !> Adds a figure of panels, which the script of the page draws.
   pure subroutine add_figure(page, name, caption)
      type(page_t), intent(inout) :: page
      character(*), intent(in) :: name, caption  !! name of the figure in the data of the page; caption below it
      call add_block(page, 'figure', quoted(name), 'caption', quoted(caption))
   end subroutine add_figure

   !> Adds a legend for the pictures that follow. The names are in the order of the palette. From the second name on, lines are dashed
   !> (or points are rings). The script of a page draws the legends of its charts, so that only the mark of design remains.
   pure subroutine add_legend(page, names, has_design, has_points)
      type(page_t), intent(inout) :: page
      character(*), intent(in) :: names(:)
      logical, intent(in) :: has_design
      logical, intent(in) :: has_points          !! the charts have points without lines
      character(:), allocatable :: colour
      integer :: k

      if (has_design) call add_block(page, 'design', 'true')
      if (.not. page%has_text) return
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
      type(buffer_t) :: out

      call out%line('<!doctype html>')
      call out%line('<html lang="en"><head><meta charset="utf-8">')
      call out%line('<meta name="viewport" content="width=device-width, initial-scale=1">')
      call out%add('<meta http-equiv="Content-Security-Policy" content="default-src ''none''; img-src data:; style-src '// &
         '''unsafe-inline''')
      if (.not. page%is_static) call out%add('; script-src ''unsafe-inline''')
      call out%line('">')
      ! without an icon in the page a browser requests /favicon.ico
      call out%line('<link rel="icon" href="data:,">')
      call out%line('<title>'//escape_html(page%title)//'</title>')
      call out%line('<style>')
      call add_style(out)
      if (page%is_live) call add_live_style(out)
      call out%line('</style></head><body'// &
         trim(merge(' class="is-live">', '>                ', allocated(page%data) .and. page%has_charts))//'<main>')
      call out%line('<header><h1>'//escape_html(page%title)//'</h1>')
      if (len(page%subtitle) > 0) call out%line('<p class="subtitle">'//escape_html(page%subtitle)//'</p>')
      call out%line('</header>')
      if (.not. page%is_static) call out%line('<noscript><p>The script of this page makes its other tables, charts and '// &
         'pictures.</p>')
      if (page%contents%length() > 0) call out%add('<nav aria-label="Contents"><ul>'//page%contents%text()// &
         '<li><a href="#top">Back to top</a></li></ul></nav>')
      call out%add(page%body%text())
      if (page%has_section) call out%line('</section>')
      if (.not. page%is_static) call out%line('</noscript>')
      call out%line('</main>')
      if (.not. page%is_static) call add_scripts(page, out)
      call out%line('</body></html>')
      text = out%text()
   end function page_text

   !> Adds the data of the sections, the data of the charts, and the script.
   pure subroutine add_scripts(page, out)
      type(page_t), intent(in) :: page
      type(buffer_t), intent(inout) :: out
      type(json_t) :: sections

      sections = page%sections
      call sections%close(']')
      call sections%close('}')
      call sections%close(']')
      call out%line('<script type="application/json" id="sections">'//without_tags(sections%text())//'</script>')
      call out%add('<script type="application/json" id="data">')
      if (allocated(page%data)) call out%add(page%data)
      if (.not. allocated(page%data)) call out%add('{}')
      call out%line('</script>')
      call out%line('<script type="module">')
      call add_script(out)
      if (page%has_figures) call add_figure_script(out)
      if (page%has_turntable) call add_turntable_script(out)
      if (page%is_live) call add_live_script(out)
      call out%line('</script>')
   end subroutine add_scripts

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
