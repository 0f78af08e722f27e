!> elastokin schema: the keys of a deck as JSON Schema, from the table of keys that the reader uses.
!>
!> The schema describes a deck as data: an object with a list of records for each group, or one record for a group that occurs
!> once.
module ek_schema
   use ek_error, only: error_t
   use ek_text, only: str
   use ek_json, only: json_t, json_string
   use ek_dimension, only: pure_number, unit_formula
   use ek_number_range, only: positive, not_negative, not_zero, share
   use ek_group, only: case_group, group_names, group_summaries, occurs_once, is_deck_group, key_t, keys, find_key, number, whole, &
      long_whole, switch, longest, word_length
   use ek_choices, only: choices_of, named_group, built_in_name
   use ek_console, only: print_text
   implicit none(type, external)
   private
   public :: print_schema, schema_text

   character(*), parameter :: name_pattern = '^[A-Za-z][A-Za-z0-9_]*$'

contains

   !> Prints the schema to standard output.
   subroutine print_schema(error)
      type(error_t), allocatable, intent(out) :: error
      call print_text(schema_text(), error)
   end subroutine print_schema

   !> The schema of a deck as text.
   function schema_text() result(text)
      character(:), allocatable :: text
      type(json_t) :: json
      integer :: g

      call json%open('{')
      call json%item('$schema', json_string('https://json-schema.org/draft/2020-12/schema'))
      call json%item('title', json_string('deck'))
      call json%item('description', json_string('A deck of elastokin as data: a list of records for each group. '// &
         'x-unit: length, force, angle and mass are the units that model selects; deflection and reaction are those of the '// &
         'measure, driver or element that the record names; swept is the swept value of a case. '// &
         'x-names: group whose items the strings name; examples: names that exist in every deck.'))
      call json%item('type', json_string('object'))
      call json%open('{', 'properties')
      do g = 1, size(group_names)
         if (is_deck_group(g)) call add_group(g)
      end do
      call json%close('}')
      call json%item('additionalProperties', 'false')
      call json%open('[', 'anyOf')      ! an included file may contain these groups
      call json%item_of_list('{"required": ["model", "body"]}')
      call json%item_of_list('{"required": ["include"]}')
      call json%close(']')
      call json%open('{', '$defs')
      do g = 1, size(group_names)
         if (is_deck_group(g)) call add_record(json, g)
      end do
      call json%close('}')
      call json%close('}')
      text = json%text()

   contains

      !> Adds a group as a property of the deck.
      subroutine add_group(g)
         integer, intent(in) :: g
         character(:), allocatable :: reference

         reference = '{"$ref": '//json_string('#/$defs/'//trim(group_names(g)))//'}'
         if (.not. occurs_once(g)) reference = '{"type": "array", "items": '//reference//'}'
         call json%item(trim(group_names(g)), reference)
      end subroutine add_group

   end function schema_text

   !> Adds the schema of the records of a group.
   subroutine add_record(json, g)
      type(json_t), intent(inout) :: json
      integer, intent(in) :: g
      type(key_t) :: note
      logical :: is_known
      integer :: k

      call json%open('{', trim(group_names(g)))
      call json%item('description', json_string(trim(group_summaries(g))))
      call json%item('type', json_string('object'))
      call json%open('{', 'properties')
      do k = 1, size(keys)
         if (keys(k)%group == g) call add_key(json, g, keys(k))
      end do
      call find_key(g, 'note', note, is_known)
      call add_key(json, g, note)
      call json%close('}')
      if (g == case_group) then                       ! the default name of a case is that of its test
         call json%item('anyOf', '[{"required": ["name"]}, {"required": ["test"]}]')
      else if (any(keys%group == g .and. keys%is_required)) then
         call json%open('[', 'required')
         do k = 1, size(keys)
            if (keys(k)%group == g .and. keys(k)%is_required) call json%item_of_list(json_string(trim(keys(k)%name)))
         end do
         call json%close(']')
      end if
      call json%item('additionalProperties', 'false')
      call json%close('}')
   end subroutine add_record

   !> Adds the schema of a key of a group: meaning, type, number of values, default and unit.
   subroutine add_key(json, g, row)
      type(json_t), intent(inout) :: json
      integer, intent(in) :: g
      type(key_t), intent(in) :: row
      character(:), allocatable :: one, list

      one = type_of_value(g, row)
      list = '"type": "array", "items": {'//one//'}, "minItems": '//str(row%least)//', "maxItems": '//str(row%most)
      call json%open('{', trim(row%name))
      call json%item('description', json_string(trim(row%about)))
      if (row%most == 1) then
         call add_items(json, one)
      else if (row%least > 1) then
         call add_items(json, list)
      else
         call json%item('anyOf', '[{'//one//'}, {'//list//'}]')      ! one value may stand for a list of one
      end if
      if (row%default /= '') call json%item('default', default_of(row))
      if (row%dimension /= pure_number) call json%item('x-unit', json_string(unit_formula(row%dimension)))
      if (named_group(row) > 0) call json%item('x-names', json_string(trim(group_names(named_group(row)))))
      if (built_in_name(row) /= '') call json%item('examples', '['//json_string(trim(built_in_name(row)))//']')
      call json%close('}')
   end subroutine add_key

   !> Adds the items of a literal '"a": 1, "b": 2' to an object.
   subroutine add_items(json, items)
      type(json_t), intent(inout) :: json
      character(*), intent(in) :: items
      integer :: colon

      colon = index(items, ': ')      ! the first item, with the others behind its value
      call json%item(items(2:colon - 2), items(colon + 2:))
   end subroutine add_items

   !> The type of one value of a key, with its range or its accepted strings, as items of an object.
   function type_of_value(g, row) result(items)
      integer, intent(in) :: g
      type(key_t), intent(in) :: row
      character(:), allocatable :: items
      character(word_length), allocatable :: accepted(:)
      integer :: k

      select case (row%type)
      case (number)
         items = '"type": "number"'
         select case (row%range)
         case (positive)
            items = items//', "exclusiveMinimum": 0'
         case (not_negative)
            items = items//', "minimum": 0'
         case (not_zero)
            items = items//', "not": {"const": 0}'
         case (share)
            items = items//', "minimum": 0, "maximum": 1'
         end select
      case (whole, long_whole)
         items = '"type": "integer", "minimum": 1'
      case (switch)
         items = '"type": "boolean"'
      case default
         items = '"type": "string", "maxLength": '//str(longest(row%type))
         accepted = choices_of(g, trim(row%name))
         if (row%name == 'name') items = items//', "pattern": '//json_string(name_pattern)
         do k = 1, size(accepted)
            if (k == 1) items = '"type": "string", "enum": ['
            if (k > 1) items = items//', '
            items = items//json_string(trim(accepted(k)))
            if (k == size(accepted)) items = items//']'
         end do
      end select
   end function type_of_value

   !> The default of a key as a literal, for each element of a list.
   function default_of(row) result(literal)
      type(key_t), intent(in) :: row
      character(:), allocatable :: literal, one
      integer :: k

      select case (row%type)
      case (number)
         one = trim(row%default)
      case (switch)
         one = row%default(2:len_trim(row%default) - 1)
      case default
         one = json_string(trim(row%default))
      end select
      literal = one
      if (row%least == 1) return
      do k = 2, row%least
         literal = literal//', '//one
      end do
      literal = '['//literal//']'
   end function default_of

end module ek_schema
