# dmg_precompile_headers(<target> [<header>...]): with DMG_PRECOMPILED_HEADERS, the target reads Eigen, the standard library and the
# given headers once. This is an option, since a compiler cache gains more where several trees share it, and caches distinguish
# precompiled headers of different trees. Sources include what they use all the same: the preset vtk-asan builds without the option.
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
