# dmg_precompile_headers(<target> [<header>...]): with DMG_PRECOMPILED_HEADERS, the target reads Eigen, the standard
# library and the given headers once, which is half of the time of a source of the core. A compiler cache gains more where
# trees share it, and it tells precompiled headers of different trees apart; hence an option. Sources include what they use
# all the same: builds without the option, as that of the preset vtk-asan, notice it.
function (dmg_precompile_headers target)
  if (DMG_PRECOMPILED_HEADERS)
    target_precompile_headers(${target} PRIVATE
      <algorithm> <array> <atomic> <cmath> <complex> <cstdint> <functional> <limits> <map> <memory> <mutex> <numeric>
      <optional> <sstream> <string> <tuple> <unordered_map> <utility> <vector>
      <Eigen/Core> <Eigen/Geometry> <Eigen/SparseCore>
      ${ARGN})
  endif ()
endfunction ()

# Tests of one folder share what dmgTestSupport read: dmg_share_precompiled_headers(<target>).
function (dmg_share_precompiled_headers target)
  if (DMG_PRECOMPILED_HEADERS)
    target_precompile_headers(${target} REUSE_FROM dmgTestSupport)
  endif ()
endfunction ()
