# Every room of src/ is one target hemo_<room>. A room without sources is an interface target.
add_library(hemo_flags INTERFACE)
target_compile_options(hemo_flags INTERFACE
  -Wall -Wextra -Werror=return-type
  $<$<CONFIG:Release>:-O3 -fno-math-errno -fno-trapping-math>
  $<$<BOOL:${HEMOMAG_SANITIZE}>:-fsanitize=address,undefined -fno-omit-frame-pointer>)
target_link_options(hemo_flags INTERFACE $<$<BOOL:${HEMOMAG_SANITIZE}>:-fsanitize=address,undefined>)

# hemo_room(NAME [SOURCES ...] [DEPENDS ...])
function(hemo_room name)
  cmake_parse_arguments(ROOM "" "" "SOURCES;DEPENDS" ${ARGN})
  if(ROOM_SOURCES)
    add_library(hemo_${name} STATIC ${ROOM_SOURCES})
    target_include_directories(hemo_${name} PUBLIC ${PROJECT_SOURCE_DIR}/src)
    target_link_libraries(hemo_${name} PUBLIC hemo_flags ${ROOM_DEPENDS})
  else()
    add_library(hemo_${name} INTERFACE)
    target_include_directories(hemo_${name} INTERFACE ${PROJECT_SOURCE_DIR}/src)
    target_link_libraries(hemo_${name} INTERFACE hemo_flags ${ROOM_DEPENDS})
  endif()
endfunction()
