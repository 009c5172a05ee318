#ifndef dmgTestNamedSurfaces_h
#define dmgTestNamedSurfaces_h

#include "Support/MeshFactory.h"

#include <string>
#include <vector>

/// The surfaces that most tests go through, of every kind that the method promises to serve.
namespace dmg::test
{

struct NamedSurface
{
  std::string Name; ///< for traces
  Surface Shape;
};

/// Closed, with boundary, with genus, thin, in parts; some hundred faces, for operators. Faces with
/// zero area are left to tests that allow them.
std::vector<NamedSurface> SmallSurfaces();

/// The same kinds with some thousand faces, enough for two coarse levels of 60 and more.
std::vector<NamedSurface> SurfacesToDecimate();

}

#endif
