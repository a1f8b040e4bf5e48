# The binaries inside co-simulation FMUs, made when Floatframe is built, so that `floatframe fmu` needs no compiler:
#   lib/fmu/linux64/floatframe_fmu.so   libc and libm only; both instruction sets in one file, chosen when it is loaded
#   lib/fmu/win64/floatframe_fmu.dll    SSE2, by the cross compiler of g++-mingw-w64-x86-64-posix, where it is installed
# Both hold the rooms that load a packed model and step it, and the functions of FMI in src/fmi. The first is linked from the
# objects of the library itself: a step in an FMU runs the instructions that it runs in a program.

# Rooms between a packed model and a step, besides those of steps. Unused functions of theirs are left out by the linker.
set(rooms_of_runtime core math formulas roads tyres description body model loops tangents start reactions stepping packed c_interface)
# Of these, what reads other files, prepares finite elements or needs another system: no function of an FMU calls it.
set(files_not_in_runtime
    c_interface/open_model_file packed/pack body/fe_* body/point_invariants body/surface_mesh core/atomic_file core/folder_lock core/growing_file
    core/json_text core/library_path core/output_files core/output_place core/text_table math/blas_room math/lowest_motions
    math/rainflow math/resolvent math/second_order_subspace math/sparse_* model/build_flexible model/*_hints roads/crg_file roads/crg_header roads/crg_source)
# The entry of each copy of the runtime into the functions of floatframe.h.
set(entry_of_runtime floatframe_function_table)

file(GLOB fmi_sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/fmi/*.cpp)
set(runtime_folder ${CMAKE_CURRENT_BINARY_DIR}/fmu)

# One relocatable object of a copy of the library, of which only the entry is seen: the two copies share no inline function.
function(floatframe_runtime_copy library entry)
  set(objects $<FILTER:$<TARGET_OBJECTS:${library}>,INCLUDE,[.]o$>)  # without the precompiled header
  foreach(room IN LISTS rooms_of_runtime)
    if(TARGET floatframe_room_${room})
      list(APPEND objects $<FILTER:$<FILTER:$<TARGET_OBJECTS:floatframe_room_${room}>,INCLUDE,[.]o$>,EXCLUDE,open_model_file>)
    endif()
  endforeach()
  set(whole ${runtime_folder}/${library}_whole.o)
  set(copy ${runtime_folder}/${library}.o)
  add_custom_command(OUTPUT ${copy} BYPRODUCTS ${whole}
    COMMAND ${CMAKE_COMMAND} -E make_directory ${runtime_folder}
    COMMAND ${CMAKE_LINKER} -r --force-group-allocation -o ${whole} ${objects}
    COMMAND ${CMAKE_OBJCOPY} --redefine-sym ${entry_of_runtime}=${entry} --keep-global-symbol=${entry} ${whole} ${copy}
    DEPENDS ${objects} VERBATIM COMMAND_EXPAND_LISTS
    COMMENT "Linking the copy of ${library} for FMUs")
  set_source_files_properties(${copy} PROPERTIES EXTERNAL_OBJECT ON GENERATED ON)
  set(copies_of_runtime ${copies_of_runtime} ${copy} PARENT_SCOPE)
endfunction()

set(copies_of_runtime "")
floatframe_runtime_copy(floatframe ${entry_of_runtime})
if(TARGET floatframe_v3)
  floatframe_runtime_copy(floatframe_v3 ${entry_of_runtime}_v3)
endif()

# What the objects of the library call of fmt is compiled in, since its library is not on every machine.
set(text_formatting ${CMAKE_CURRENT_SOURCE_DIR}/fmi/linux/text_formatting.cpp)
set_source_files_properties(${text_formatting} PROPERTIES
  COMPILE_OPTIONS -fkeep-inline-functions INCLUDE_DIRECTORIES "$<TARGET_PROPERTY:fmt::fmt,INTERFACE_INCLUDE_DIRECTORIES>")
add_library(floatframe_fmu MODULE ${fmi_sources} ${text_formatting} ${copies_of_runtime})
target_include_directories(floatframe_fmu PRIVATE ${CMAKE_CURRENT_SOURCE_DIR} ${PROJECT_BINARY_DIR}/generated)
target_compile_definitions(floatframe_fmu PRIVATE FLOATFRAME_FMU_V3=$<TARGET_EXISTS:floatframe_v3>)
target_link_libraries(floatframe_fmu PRIVATE floatframe_compiler)
target_compile_options(floatframe_fmu PRIVATE -fvisibility=hidden -ffunction-sections -fdata-sections)
target_link_options(floatframe_fmu PRIVATE
  -static-libstdc++ -static-libgcc -Wl,--gc-sections -Wl,-Bsymbolic -Wl,-z,defs -Wl,-s
  -Wl,--version-script=${CMAKE_CURRENT_SOURCE_DIR}/fmi/exports.map)
set_target_properties(floatframe_fmu PROPERTIES
  PREFIX "" CXX_VISIBILITY_PRESET hidden FLOATFRAME_OPTIMISATION -O2
  LINK_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/fmi/exports.map
  LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib/fmu/linux64)
install(TARGETS floatframe_fmu LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/floatframe/fmu/linux64)
set(fmu_runtimes floatframe_fmu)

# For Windows: the same sources, room by room as one, by the cross compiler. Its stack is aligned to 16 bytes, and threads of
# importers have 1 MB of it.
if(FLOATFRAME_FMU_WIN64)
  find_program(FLOATFRAME_MINGW x86_64-w64-mingw32-g++-posix)
  if(NOT FLOATFRAME_MINGW)
    message(STATUS "g++-mingw-w64-x86-64-posix was not found: FMUs will run on Linux only")
  endif()
endif()
if(FLOATFRAME_FMU_WIN64 AND FLOATFRAME_MINGW)
  # Only these two of the headers of the system: all others are those of the cross compiler.
  set(mingw_headers ${runtime_folder}/include)
  file(MAKE_DIRECTORY ${mingw_headers})
  foreach(library Eigen3::Eigen:Eigen fmt::fmt:fmt)
    string(REGEX MATCH "(.*):([a-zA-Z]+)$" matched ${library})
    get_target_property(folders ${CMAKE_MATCH_1} INTERFACE_INCLUDE_DIRECTORIES)
    find_path(headers_of_${CMAKE_MATCH_2} ${CMAKE_MATCH_2} PATHS ${folders} NO_DEFAULT_PATH REQUIRED)
    mark_as_advanced(headers_of_${CMAKE_MATCH_2})
    file(CREATE_LINK ${headers_of_${CMAKE_MATCH_2}}/${CMAKE_MATCH_2} ${mingw_headers}/${CMAKE_MATCH_2} SYMBOLIC)
  endforeach()
  set(mingw_command ${CMAKE_CXX_COMPILER_LAUNCHER} ${FLOATFRAME_MINGW} -std=c++20 -O2 -DNDEBUG -fno-math-errno -fno-trapping-math
      -ffunction-sections -fdata-sections -Wall -Wextra -Wno-attributes
      -Wno-maybe-uninitialized -Wno-restrict -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread
      --param=large-unit-insns=1000000 --param=max-inline-insns-auto=100 --param=max-inline-insns-single=600
      -DFMT_HEADER_ONLY -DEIGEN_MPL2_ONLY -DEIGEN_MAX_ALIGN_BYTES=16 -DEIGEN_MAX_STATIC_ALIGN_BYTES=16
      -DEIGEN_STACK_ALLOCATION_LIMIT=131072 -DFLOATFRAME_WITHOUT_ABI_GUARD -DFLOATFRAME_API= -DFLOATFRAME_FMU_V3=0
      -I${CMAKE_CURRENT_SOURCE_DIR} -I${PROJECT_BINARY_DIR}/generated -isystem ${mingw_headers})
  # Patterns as regular expressions; a source of step time is in the room that it stands in.
  list(TRANSFORM files_not_in_runtime REPLACE "[*]" "[a-z_0-9]*" OUTPUT_VARIABLE left_out)
  list(JOIN left_out "|" left_out)
  set(dll_sources ${fmi_sources})  # one by one: one of them sees the macros of Windows
  foreach(room IN LISTS rooms_of_runtime rooms_of_steps)
    file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/floatframe/${room}/*.cpp)
    list(FILTER sources EXCLUDE REGEX "/floatframe/(${left_out})\\.cpp$")
    if(sources)
      list(TRANSFORM sources REPLACE "(.+)" "#include \"\\1\"\n" OUTPUT_VARIABLE lines)
      list(JOIN lines "" text)
      file(CONFIGURE OUTPUT ${runtime_folder}/${room}.cpp CONTENT "${text}" @ONLY)
      list(APPEND dll_sources ${runtime_folder}/${room}.cpp)
    endif()
  endforeach()
  set(dll_objects "")
  foreach(source IN LISTS dll_sources)
    cmake_path(GET source STEM name)
    set(object ${runtime_folder}/win64_${name}.obj)
    add_custom_command(OUTPUT ${object}
      COMMAND ${mingw_command} -MD -MF ${object}.d -MT ${object} -c ${source} -o ${object}
      DEPENDS ${source} DEPFILE ${object}.d VERBATIM COMMENT "Compiling ${name} for Windows")
    list(APPEND dll_objects ${object})
  endforeach()
  set(dll ${PROJECT_BINARY_DIR}/lib/fmu/win64/floatframe_fmu.dll)
  add_custom_command(OUTPUT ${dll}
    COMMAND ${CMAKE_COMMAND} -E make_directory ${PROJECT_BINARY_DIR}/lib/fmu/win64
    COMMAND ${FLOATFRAME_MINGW} -shared -static -s -Wl,--gc-sections -Wl,--exclude-all-symbols -o ${dll} ${dll_objects}
    DEPENDS ${dll_objects} VERBATIM COMMENT "Linking floatframe_fmu.dll")
  add_custom_target(floatframe_fmu_win64 ALL DEPENDS ${dll})
  install(FILES ${dll} DESTINATION ${CMAKE_INSTALL_LIBDIR}/floatframe/fmu/win64)
  list(APPEND fmu_runtimes floatframe_fmu_win64)
endif()

# A program that was built can export FMUs.
if(TARGET floatframe_program)
  add_dependencies(floatframe_program ${fmu_runtimes})
endif()
