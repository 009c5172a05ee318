# Writes the pages that `?` opens: ours, with the table of properties that ParaView makes from the XML; and those of the method.
#
#   cmake -D SOURCE=folder of our pages -D METHOD=folder of the core -D GENERATED=folder of ParaView's -D OUTPUT=folder
#     -P HelpPages.cmake
#
# The pages that are written here replace ParaView's in a later step; so the table may be found in either, always as the last one.
# The table of properties on a page.
function (find_table page result)
  file(READ "${GENERATED}/${page}" generated)
  string(FIND "${generated}" "<table width=\"97%\"" begin)
  string(FIND "${generated}" "</table>" end REVERSE)
  set(table "")
  if (NOT begin EQUAL -1)
    math(EXPR length "${end} + 8 - ${begin}")
    string(SUBSTRING "${generated}" ${begin} ${length} table)
  endif ()
  set(${result} "${table}" PARENT_SCOPE)
endfunction ()

file(GLOB pages RELATIVE "${GENERATED}" "${GENERATED}/filters.*.html")
foreach (page IN LISTS pages)
  string(REGEX REPLACE "^filters\\." "${SOURCE}/" source "${page}")
  set(kind "")
  if (page MATCHES "^filters\\.(Cross|Fibre|Line|Vector)(Field|Orientation)\\.html$") # see KindsOfFields.xml
    set(kind "${CMAKE_MATCH_1} ${CMAKE_MATCH_2}")
    set(source "${SOURCE}/DirectionalField.html")
  endif ()
  if (NOT EXISTS "${source}")
    message(FATAL_ERROR "the filter of ${page} has no help page ${source}")
  endif ()
  find_table("${page}" properties)
  file(READ "${source}" text)
  string(REPLACE "<!-- properties -->" "${properties}" text "${text}")
  if (kind)
    string(REPLACE "<h1>Directional Field</h1>" "<h1>${kind}</h1>\n<p>Directional Field for this kind of field:</p>" text "${text}")
  endif ()
  file(WRITE "${OUTPUT}/${page}" "${text}")
endforeach ()

file(GLOB pages "${METHOD}/*/*.md")
foreach (path IN LISTS pages)
  get_filename_component(page "${path}" NAME)
  file(READ "${path}" text)
  string(REPLACE "../../../ParaViewPlugin/Documentation/" "" text "${text}") # the pictures lie beside them here
  file(WRITE "${OUTPUT}/${page}" "${text}")
endforeach ()
