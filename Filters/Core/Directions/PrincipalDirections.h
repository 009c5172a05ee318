#ifndef dmgPrincipalDirections_h
#define dmgPrincipalDirections_h

#include "Mesh/FramedMesh.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <string>

namespace dmg
{

/// The principal curvatures and directions at each face, or at each vertex.
struct PrincipalCurvatures
{
  /// Unit, in the frame of the element, along which the surface bends by Maximum; the other principal direction is a
  /// quarter turn from it. Zero where Confidence is.
  Vector<Complex> MaximumDirections;
  Vector<double> Maximum; ///< 1 / length, positive where the surface bends away from its normal
  Vector<double> Minimum; ///< at most Maximum
  /// How clear the directions are: the square of (Maximum - Minimum) / (|Maximum| + |Minimum| + 1 / D), D the diagonal
  /// of the box around the surface. (For noise in the curvatures, the variance of their directions is inverse to the
  /// square of their difference.) In [0, 1), near to 1 on cylinders and saddles, near to 0 on spheres and what is almost
  /// flat; 0 where the ratio is below 1e-6, as rounding leaves it.
  Vector<double> Confidence;
};

struct PrincipalDirections
{
  PrincipalCurvatures Faces;
  PrincipalCurvatures Vertices;
};

/// Principal curvatures and their directions, at a scale: the mean of the shape operator over a region around each
/// vertex, and over those of its three vertices for each face.
///
/// A region holds what lies nearer to its vertex than \p scale times the mean length of the edges, as far as it is
/// reached by edges that lie there, and the neighbours of the vertex; where the surface has much shorter edges than
/// elsewhere, no more than the nearest 16 scale^2 + 16 vertices, four times as many as on an even surface. From any
/// vertex but the first, a region goes on to no more than that number of neighbours.
///
/// On a face, the shape operator is the derivative of the vertices' normals, interpolated between its corners
/// (Rusinkiewicz 2004, "Estimating curvatures and their derivatives on triangle meshes"). Its integral over a region is a
/// corrected curvature measure (Lachaud, Romon and Thibert 2022, "Corrected curvature measures"), which like the normal
/// cycle (Cohen-Steiner and Morvan 2003) depends on the rim of the region alone: noise inside cancels. On noisy
/// ellipsoids, tori and cylinders its directions are nearer to the exact ones than those of normal cycles and of
/// quadrics fitted to the same points (CGAL's Monge_via_jet_fitting): see the section on principal directions in
/// Testing/Benchmarks/README.md.
///
/// A larger scale withstands more noise and sees less detail; without noise, the error of curvatures grows with the square
/// of it. Faces that touch the boundary, where normals look to one side, count in regions without other faces alone: at the boundary the error
/// grows with the scale.
/// \param scale finite, >= 0.
/// \throw Cancelled
/// Cost: O(scale^2) for each vertex, and at most O(scale^4) near vertices of many neighbours.
PrincipalDirections FindPrincipalDirections(
  const FramedMesh& surface, double scale, const ExecutionContext& context = SerialContext());

/// The share of the area where regions reach around bends that the triangles resolve: the largest curvature times the radius of regions
/// is above 0.7, where it is found a sixth too small on a cylinder, and times the height of the face below 0.1. So it is at large
/// scales, and at any but small ones on thin triangles, since the mean edge is then much longer than triangles are high.
/// \param scale of FindPrincipalDirections.
/// Cost: O(#F).
double ShareBentWithinScale(const FramedMesh& surface, const PrincipalDirections& directions, double scale);
/// The warning of it, for the user; empty where the share is below a fifth.
std::string WarningOfScale(const FramedMesh& surface, const PrincipalDirections& directions, double scale);

/// Chooses the signs of the directions, which have none, so that each continues as that of the next face wherever possible
/// (CombingLabels); those of vertices agree with the faces around. Drawings that interpolate vectors need that.
/// Cost: O(#F).
void CombSigns(
  const FramedMesh& surface, PrincipalDirections& directions, const ExecutionContext& context = SerialContext());

}

#endif
