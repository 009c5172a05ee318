#ifndef dmgQuadDistances_h
#define dmgQuadDistances_h

#include "Mesh/TriangleMesh.h"
#include "Places/NearestPlaces.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <array>
#include <vector>

namespace dmg
{

/// The distance of each vertex of a surface from its quads, each of which is drawn as four triangles around its middle.
/// \param quads a manifold; vertices without quads are left out.
/// \return empty where a quad has all of its corners in one place.
/// Cost: a search for each vertex of the surface, and a tree of the quads.
Vector<double> DistancesFromQuads(const TriangleMesh& mesh, const std::vector<std::array<int, 4>>& quads,
  const Points& positions, const ExecutionContext& context = SerialContext());

/// The largest distance of the middle and of the middles of the sides of each quad from the surface.
/// \param faces by quad, a face of the surface that is not far.
Vector<double> DistancesFromSurface(const NearestPlaces& surface, const std::vector<std::array<int, 4>>& quads,
  const std::vector<int>& faces, const Points& positions, const ExecutionContext& context = SerialContext());

/// The area of each quad, as four triangles around its middle.
Vector<double> AreasOfQuads(const std::vector<std::array<int, 4>>& quads, const Points& positions);

}

#endif
