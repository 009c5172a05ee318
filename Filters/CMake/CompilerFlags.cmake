# dmg_add_flags(<target> <flag>...): compiles a target with those of the flags that the compiler knows.
include(CheckCXXCompilerFlag)
function (dmg_add_flags target)
  foreach (flag IN LISTS ARGN)
    string(MAKE_C_IDENTIFIER "DMG_HAS${flag}" known)
    check_cxx_compiler_flag("${flag}" ${known})
    if (${known})
      target_compile_options(${target} PRIVATE "${flag}")
    endif ()
  endforeach ()
endfunction ()

# dmg_add_warnings(<target>): the usual warnings of GCC and Clang. MSVC has another meaning for -Wall.
function (dmg_add_warnings target)
  if (NOT MSVC)
    dmg_add_flags(${target} -Wall -Wextra)
  endif ()
endfunction ()
