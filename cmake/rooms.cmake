# Every room of src/ is one target hemo_<room>. A room without sources is an interface target.
add_library(hemo_flags INTERFACE)
target_compile_options(hemo_flags INTERFACE
  -Wall -Wextra -Wconversion -Wnon-virtual-dtor -Werror=return-type
  $<$<CXX_COMPILER_ID:Clang>:-Wno-sign-conversion>  # what g++ does not count as -Wconversion
  $<$<CONFIG:Release>:-O3 -fno-math-errno -fno-trapping-math>)
if(HEMOMAG_SANITIZE)
  # A finding ends the program, so that no test can pass with one.
  target_compile_options(hemo_flags INTERFACE
    -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer -O1)
  target_compile_definitions(hemo_flags INTERFACE _GLIBCXX_ASSERTIONS)
  target_link_options(hemo_flags INTERFACE -fsanitize=address,undefined)
endif()

# What rooms are compiled with. Fuzzing watches all of it but the kernels of hemo_simd, which no file reaches.
add_library(hemo_room_flags INTERFACE)
target_link_libraries(hemo_room_flags INTERFACE hemo_flags)
if(HEMOMAG_FUZZ)
  set(fuzz_flags -fsanitize=fuzzer-no-link,address,undefined,float-cast-overflow -fno-sanitize-recover=all)
  target_compile_options(hemo_room_flags INTERFACE ${fuzz_flags} -fno-omit-frame-pointer)
  target_compile_definitions(hemo_room_flags INTERFACE _GLIBCXX_ASSERTIONS)
  target_link_options(hemo_room_flags INTERFACE ${fuzz_flags})
endif()

# hemo_room(NAME [SOURCES ...] [DEPENDS ...])
function(hemo_room name)
  cmake_parse_arguments(ROOM "" "" "SOURCES;DEPENDS" ${ARGN})
  if(ROOM_SOURCES)
    add_library(hemo_${name} STATIC ${ROOM_SOURCES})
    target_include_directories(hemo_${name} PUBLIC ${PROJECT_SOURCE_DIR}/src)
    target_link_libraries(hemo_${name} PUBLIC hemo_room_flags ${ROOM_DEPENDS})
  else()
    add_library(hemo_${name} INTERFACE)
    target_include_directories(hemo_${name} INTERFACE ${PROJECT_SOURCE_DIR}/src)
    target_link_libraries(hemo_${name} INTERFACE hemo_room_flags ${ROOM_DEPENDS})
  endif()
endfunction()

# hemo_simd(ROOM FILE): compile FILE once per instruction set into the room's library. The file puts everything
# it defines into the namespace HEMOMAG_SIMD (sse2, avx2 or avx512) and may use no inline function that another
# file could share, or the linker might keep the copy that an older processor cannot run.
function(hemo_simd room file)
  set(flags_sse2 "")
  set(flags_avx2 -mavx2 -mfma)
  set(flags_avx512 -mavx512f -mavx512dq -mavx512vl -mavx512bw -mfma -mprefer-vector-width=512)
  foreach(level sse2 avx2 avx512)
    get_filename_component(stem ${file} NAME_WE)
    set(target hemo_${room}_${stem}_${level})
    add_library(${target} OBJECT ${file})
    target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/src)
    target_link_libraries(${target} PRIVATE hemo_flags)
    target_compile_definitions(${target} PRIVATE HEMOMAG_SIMD=${level} HEMOMAG_SIMD_${level})
    target_compile_options(${target} PRIVATE ${flags_${level}} -ffp-contract=fast -fno-signed-zeros -Wno-psabi)
    target_sources(hemo_${room} PRIVATE $<TARGET_OBJECTS:${target}>)
  endforeach()
endfunction()
