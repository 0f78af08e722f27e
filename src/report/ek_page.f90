!> A page of results as one self-contained HTML file: headings, tables and embedded pictures.
!>
!> No script, font or picture is fetched. The page is laid out for a screen, in one column for a phone (tables scroll in
!> their own box), and for paper (A4, each section on a new page). Every input text is escaped here.
module ek_page
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_is_nan
   use ek_kinds, only: wp
   use ek_error, only: message_list_t
   use ek_text, only: str
   use ek_buffer, only: buffer_t
   use ek_svg, only: embedded_svg, escape_html
   use ek_chart, only: palette
   implicit none(type, external)
   private
   public :: page_t, begin_page, begin_section, add_text, add_warnings, add_facts
   public :: begin_table, add_cell, add_group, end_table
   public :: begin_charts, end_charts, add_picture, add_data_picture, add_legend, page_text, page_number

   character(*), parameter :: nl = new_line('a')

   !> The style sheet: screen, dark, phone, paper.
   character(*), parameter :: style = &
      ':root{color-scheme:light dark;--ink:#1d2228;--soft:#5b6570;--line:#d9dee4;--paper:#fff;--band:#f4f6f8;'// &
      '--warn:#fff4e0;--warnline:#e0a030;--link:#0b5cad}'//nl//'@media(prefers-color-scheme:dark){:root{--ink:#e4e8ec;'// &
      '--soft:#9aa5b1;--line:#38414a;--paper:#15191d;--band:#1f252b;--warn:#3a2d12;--warnline:#b8862d;--link:#7db7f0}}'// &
      nl//'*{box-sizing:border-box}html{-webkit-text-size-adjust:100%}'//nl//'body{margin:0;background:var(--paper);'// &
      'color:var(--ink);font:16px/1.5 system-ui,sans-serif}'//nl//'main{max-width:1280px;margin:0 auto;'// &
      'padding:24px 28px 64px}'//nl//'h1{font-size:1.9rem;line-height:1.2;margin:0 0 4px;overflow-wrap:anywhere}'// &
      'h2{font-size:1.35rem;margin:48px 0 12px;padding-top:12px;border-top:1px solid var(--line)}h3{font-size:1.02rem;'// &
      'margin:22px 0 8px}'//nl//'.subtitle{color:var(--soft);margin:0 0 14px}a{color:var(--link)}p{max-width:75ch}'//nl// &
      'nav ul{list-style:none;display:flex;flex-wrap:wrap;gap:6px 18px;margin:10px 0;padding:0;font-size:.92rem}'//nl// &
      'dl{display:flex;flex-wrap:wrap;gap:6px 32px;margin:12px 0}dl div{min-width:0}dt{color:var(--soft);font-size:.8rem}'// &
      'dd{margin:0;overflow-wrap:anywhere}'//nl//'.scroll{overflow-x:auto;margin:10px 0;-webkit-overflow-scrolling:touch}'// &
      'table{border-collapse:collapse;font-size:.9rem;min-width:100%}pre{overflow-x:auto;background:var(--band);'// &
      'padding:10px 14px;font-size:.82rem;margin:6px 0 14px}'//nl//'th,td{text-align:left;padding:4px 14px 4px 0;'// &
      'border-bottom:1px solid var(--line);vertical-align:baseline}thead th{color:var(--soft);font-weight:600;'// &
      'font-size:.8rem;white-space:nowrap}'//nl//'td.n,th.n{text-align:right;font-variant-numeric:tabular-nums;'// &
      'white-space:nowrap}td.s{color:var(--soft);font-size:.82rem}tr.group th{padding-top:16px;font-weight:650}'//nl// &
      '.charts{display:grid;grid-template-columns:repeat(auto-fill,minmax(330px,1fr));gap:14px}'//nl//'figure{margin:0;'// &
      'background:#fff;border:1px solid var(--line);border-radius:6px;padding:4px}figure.wide{margin:14px 0}svg,'// &
      'img{display:block;width:100%;height:auto}img{max-width:760px;margin:0 auto}figcaption{color:#5b6570;'// &
      'font-size:.82rem;padding:2px 10px 8px}'//nl//'.legend{display:flex;flex-wrap:wrap;gap:4px 20px;color:var(--soft);'// &
      'font-size:.88rem;margin:8px 0}.legend span{display:inline-flex;align-items:center;gap:7px}'// &
      '.legend i{display:inline-block;width:30px;height:0}.legend b{display:inline-block;width:9px;height:9px;'// &
      'border:2px solid var(--ink);border-radius:50%}'//nl//'.warning{background:var(--warn);'// &
      'border:1px solid var(--warnline);border-left-width:5px;border-radius:4px;padding:10px 16px;margin:14px 0}'// &
      '.warning ul{margin:6px 0 0;padding-left:20px}.warning li{overflow-wrap:anywhere}'//nl//'@media(max-width:700px){'// &
      'main{padding:16px 14px 48px}h1{font-size:1.45rem}h2{margin-top:34px}.charts{grid-template-columns:1fr}'// &
      'table{font-size:.84rem}td.s{min-width:15em}td:first-child{min-width:9em}}'//nl//'@page{size:A4;margin:14mm}'//nl// &
      '@media print{:root{--ink:#000;--soft:#444;--line:#bbb;--paper:#fff;--band:#fff;--warn:#fff;--link:#000}'// &
      'body{font-size:10pt}main{max-width:none;padding:0}nav{display:none}section{break-before:page}'// &
      'section:first-of-type{break-before:auto}h2{margin-top:0;border:0}h2,h3,.legend{break-after:avoid}'// &
      '.charts{grid-template-columns:1fr 1fr;gap:8px}figure,tr{break-inside:avoid}.scroll{overflow:visible}table,td.s,'// &
      'thead th{font-size:8pt}th,td{padding:2px 10px 2px 0}figure{border-color:#ddd}}'//nl

   type :: page_t
      private
      type(buffer_t) :: body, contents
      character(:), allocatable :: title
      integer :: pictures = 0, table_columns = 0
      integer :: cells = 0                  !! of the last row, while it has not all
      logical :: has_section = .false.
   end type page_t

contains

   !> A page with its title.
   pure subroutine begin_page(page, title, subtitle)
      type(page_t), intent(out) :: page
      character(*), intent(in) :: title, subtitle

      page%title = title
      call page%body%line('<header><h1>'//escape_html(title)//'</h1>')
      if (len(subtitle) > 0) call page%body%line('<p class="subtitle">'//escape_html(subtitle)//'</p>')
      call page%body%line('<!--contents--></header>')
   end subroutine begin_page

   !> Begins a section and ends the one before; on paper it starts a page. `id` has letters, digits, _ and -.
   pure subroutine begin_section(page, id, title)
      type(page_t), intent(inout) :: page
      character(*), intent(in) :: id, title

      if (page%has_section) call page%body%line('</section>')
      page%has_section = .true.
      call page%body%line('<section id="'//escape_html(id)//'"><h2>'//escape_html(title)//'</h2>')
      call page%contents%line('<li><a href="#'//escape_html(id)//'">'//escape_html(title)//'</a></li>')
   end subroutine begin_section

   !> Plain text as a paragraph 'p', or as a heading 'h3' within a section; HTML markup in it is escaped.
   pure subroutine add_text(page, tag, text)
      type(page_t), intent(inout) :: page
      character(*), intent(in) :: tag, text
      call page%body%line('<'//tag//'>'//escape_html(text)//'</'//tag//'>')
   end subroutine add_text

   !> A box of warnings; no box for an empty list.
   pure subroutine add_warnings(page, title, list)
      type(page_t), intent(inout) :: page
      character(*), intent(in) :: title
      type(message_list_t), intent(in) :: list
      integer :: k

      if (list%count() == 0) return
      call page%body%line('<div class="warning" role="note"><strong>'//escape_html(title)//'</strong><ul>')
      do k = 1, list%count()
         call page%body%line('<li>'//escape_html(list%line(k))//'</li>')
      end do
      call page%body%line('</ul></div>')
   end subroutine add_warnings

   !> Pairs of name and value, two lists of the same length.
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

   !> Begins a table with its column headings; a head that begins with '>' marks a column of numbers, aligned right.
   pure subroutine begin_table(page, heads)
      type(page_t), intent(inout) :: page
      character(*), intent(in) :: heads(:)
      integer :: k, first

      page%table_columns = size(heads)
      call page%body%add('<div class="scroll"><table><thead><tr>')
      do k = 1, size(heads)
         first = merge(2, 1, index(heads(k), '>') == 1)
         call page%body%add('<th scope="col"'//trim(merge(' class="n">', '>          ', first == 2))// &
            escape_html(trim(heads(k) (first:)))//'</th>')
      end do
      call page%body%line('</tr></thead><tbody>')
   end subroutine begin_table

   !> A heading across the table for the rows below it.
   pure subroutine add_group(page, title)
      type(page_t), intent(inout) :: page
      character(*), intent(in) :: title
      call page%body%line('<tr class="group"><th colspan="'//str(page%table_columns)//'" scope="colgroup">'// &
         escape_html(title)//'</th></tr>')
   end subroutine add_group

   !> The next cell, of text, of a number (kind 'n'), or of small text ('s'); a row has as many as the table has headings.
   pure subroutine add_cell(page, text, kind)
      type(page_t), intent(inout) :: page
      character(*), intent(in) :: text
      character(1), intent(in), optional :: kind

      if (page%cells == 0) call page%body%add('<tr>')
      call page%body%add('<td')
      if (present(kind)) call page%body%add(' class="'//kind//'"')
      call page%body%add('>'//escape_html(text)//'</td>')
      page%cells = modulo(page%cells + 1, page%table_columns)
      if (page%cells == 0) call page%body%line('</tr>')
   end subroutine add_cell

   !> Ends a table.
   pure subroutine end_table(page)
      type(page_t), intent(inout) :: page
      call page%body%line('</tbody></table></div>')
   end subroutine end_table

   !> Begins a block of charts side by side, as many as fit.
   pure subroutine begin_charts(page)
      type(page_t), intent(inout) :: page
      call page%body%line('<div class="charts">')
   end subroutine begin_charts

   !> Ends a block of charts.
   pure subroutine end_charts(page)
      type(page_t), intent(inout) :: page
      call page%body%line('</div>')
   end subroutine end_charts

   !> A picture from the SVG written by gnuplot: of full width with a caption, or one chart of a block without.
   pure subroutine add_picture(page, svg, title, caption)
      type(page_t), intent(inout) :: page
      character(*), intent(in) :: svg, title     !! content of the file; its description
      character(*), intent(in), optional :: caption

      page%pictures = page%pictures + 1
      call page%body%add(trim(merge('<figure class="wide">', '<figure>             ', present(caption))))
      call page%body%add(embedded_svg(svg, 'p'//str(page%pictures), title))
      if (present(caption)) call page%body%add('<figcaption>'//escape_html(caption)//'</figcaption>')
      call page%body%line('</figure>')
   end subroutine add_picture

   !> A raster picture (GIF, PNG) embedded in the page as base64.
   pure subroutine add_data_picture(page, bytes, kind, title, caption)
      type(page_t), intent(inout) :: page
      character(*), intent(in) :: bytes          !! content of the file
      character(*), intent(in) :: kind           !! 'gif' or 'png'
      character(*), intent(in) :: title, caption

      page%pictures = page%pictures + 1
      call page%body%add('<figure class="wide"><img alt="'//escape_html(title)//'" src="data:image/'//kind//';base64,')
      call page%body%add(base64(bytes))
      call page%body%add('">')
      if (len(caption) > 0) call page%body%add('<figcaption>'//escape_html(caption)//'</figcaption>')
      call page%body%line('</figure>')
   end subroutine add_data_picture

   !> Legend of the charts below: names in the order of the palette; from the second on dashed lines (or rings instead of
   !> points).
   pure subroutine add_legend(page, names, has_design, has_points)
      type(page_t), intent(inout) :: page
      character(*), intent(in) :: names(:)
      logical, intent(in) :: has_design
      logical, intent(in) :: has_points          !! the charts have points without lines
      character(:), allocatable :: colour
      integer :: k

      call page%body%add('<p class="legend">')
      do k = 1, size(names)
         colour = palette(modulo(k - 1, size(palette)) + 1)
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

   !> The whole page.
   pure function page_text(page) result(text)
      type(page_t), intent(in) :: page
      character(:), allocatable :: text
      character(*), parameter :: mark = '<!--contents-->'
      character(:), allocatable :: body
      type(buffer_t) :: out
      integer :: at

      body = page%body%text()
      at = index(body, mark)
      call out%line('<!doctype html>')
      call out%line('<html lang="en"><head><meta charset="utf-8">')
      call out%line('<meta name="viewport" content="width=device-width, initial-scale=1">')
      ! without an icon in the page a browser requests /favicon.ico
      call out%line('<link rel="icon" href="data:,">')
      call out%line('<title>'//escape_html(page%title)//'</title>')
      call out%line('<style>')
      call out%add(style)
      call out%line('</style></head><body><main>')
      call out%add(body(:at - 1))
      if (page%contents%length() > 0) call out%add('<nav aria-label="Contents"><ul>'//page%contents%text()//'</ul></nav>')
      call out%add(body(at + len(mark):))
      if (page%has_section) call out%line('</section>')
      call out%line('</main></body></html>')
      text = out%text()
   end function page_text

   !> A number for a table: about four digits, an exponent only from 1e7 on; '–' for a missing value.
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

   !> Base64 encoding, RFC 4648.
   pure function base64(bytes) result(text)
      character(*), intent(in) :: bytes
      character(:), allocatable :: text
      character(*), parameter :: letters = 'ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/'
      integer :: k, l, three, at

      text = repeat('=', 4*((len(bytes) + 2)/3))
      at = 0
      do k = 1, len(bytes), 3
         three = 0
         do l = k, k + 2
            three = 256*three
            if (l <= len(bytes)) three = three + iachar(bytes(l:l))
         end do
         do l = 1, min(4, len(bytes) - k + 2)
            text(at + l:at + l) = letters(ibits(three, 24 - 6*l, 6) + 1:ibits(three, 24 - 6*l, 6) + 1)
         end do
         at = at + 4
      end do
   end function base64

end module ek_page
