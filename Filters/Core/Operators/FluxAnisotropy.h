#ifndef dmgFluxAnisotropy_h
#define dmgFluxAnisotropy_h

#include "Mesh/TriangleMesh.h"
#include "Support/ExecutionContext.h"

namespace dmg
{

/// The dependence of the energy of PowerLaplacian on the direction in which a field changes. The Dirichlet energy has none.
///
/// A linear function of slope p has the energy p^T T p around a face: T is the sum of w_e d_e d_e^T over its edges, half of each,
/// over the area, d_e the unfolded vector between the centroids of the two faces, w_e PowerEdgeWeight. The mean of T over the
/// hundred faces that are nearest to \p face, counted across edges, has eigenvalues t (1 + a) and t (1 - a), and a is the
/// anisotropy. It is 0 on equilateral triangles, 2 / 7 on squares that are all cut along the same diagonal, and small where shears
/// of neighbours cancel, as they do on even scans.
/// \return from 0 to 1.
double FluxAnisotropy(const TriangleMesh& mesh, int face);

/// The share of the area where the anisotropy is above 0.2: fields change one and a half times as easily in one direction as in the other.
/// It tells meshes on which power fields on faces are right within some percent from those on which they are not. The share is
/// estimated from 256 faces that are spread evenly over the area, which is right within some 3 percent of the area.
/// Cost: areas of all faces, and that of the estimate, which is the same for all surfaces.
double ShareOfShearedArea(const TriangleMesh& mesh, const ExecutionContext& context = SerialContext());

}

#endif
