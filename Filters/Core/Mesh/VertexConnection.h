#ifndef dmgVertexConnection_h
#define dmgVertexConnection_h

#include "Mesh/FramedMesh.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"
#include "Support/Unfilled.h"

#include <vector>

namespace dmg
{

/// The tangent planes at the vertices of a surface and how directions are carried between them along edges: the discrete
/// Levi-Civita connection by cone angles (Knoeppel et al. 2013, section 3; Zhang et al. 2006).
///
/// The angles around an inner vertex are stretched by one factor, so that they sum to 2 pi; an edge then has a polar
/// angle at each of its ends, and a direction that is carried along the edge keeps its angle to it. At boundary vertices
/// angles stay as they are: their sum says how the boundary bends, which is no curvature of the surface, and a parallel
/// field on a flat disc stays parallel.
///
/// Polar angles count in VertexFrames: the zero of each vertex is chosen such that, in the mean of the corners by angle,
/// directions that are carried from the faces around arrive where the shortest rotation between the normals carries
/// them. The choice has no effect on energies.
class VertexConnection
{
public:
  /// Cost: O(#F).
  explicit VertexConnection(const FramedMesh& surface, const ExecutionContext& context = SerialContext());

  /// The direction of a halfedge at its tail.
  double PolarAngle(int halfedge) const { return this->PolarAngles[halfedge]; }
  /// The angle of the corner at the tail of a halfedge, stretched.
  double CornerAngle(int halfedge) const { return this->CornerAngles[halfedge]; }
  /// Carries directions along a halfedge, from the frame of its tail into that of its head; in radians, not reduced.
  double Transport(int halfedge) const
  {
    const int next = TriangleMesh::Next(halfedge);
    return this->PolarAngles[next] + this->CornerAngles[next] + Pi - this->PolarAngles[halfedge] + this->Turn(halfedge);
  }
  /// The curvature of a face: what its stretched angles exceed pi by. Carried once around the face, counter-clockwise, a
  /// direction turns by it. On a closed surface all faces sum to 2 pi times the Euler characteristic.
  double Curvature(int face) const
  {
    return this->CornerAngles[3 * face] + this->CornerAngles[3 * face + 1] + this->CornerAngles[3 * face + 2] - Pi +
      this->Turn(3 * face) + this->Turn(3 * face + 1) + this->Turn(3 * face + 2);
  }
  /// Takes the connection of the metric in which lengths at each vertex count over its own: while a direction is carried along a path, it turns by
  /// the integral of the derivative of log(length) to the right of the path. Angles stay.
  /// \param lengths #V, > 0. \param mesh of this connection. Cost: O(#F).
  void SetLengths(const TriangleMesh& mesh, const std::vector<double>& lengths);
  /// Carries directions from the face of a halfedge (FaceFrames) into the frame of its tail: the bisectors of the corner
  /// coincide.
  Complex TurnFromFace(int halfedge) const { return this->TurnsFromFaces[halfedge]; }

  /// The numbers above at the tail of a halfedge.
  struct CornerNumbers
  {
    double PolarAngle;
    double CornerAngle;
    Complex TurnFromFace;
  };
  CornerNumbers Corner(int halfedge) const
  {
    return { this->PolarAngles[halfedge], this->CornerAngles[halfedge], this->TurnsFromFaces[halfedge] };
  }
  /// Takes the numbers of a larger surface, for a mesh that is a part of it and ends within a fan.
  void SetCorner(int halfedge, const CornerNumbers& numbers)
  {
    this->PolarAngles[halfedge] = numbers.PolarAngle;
    this->CornerAngles[halfedge] = numbers.CornerAngle;
    this->TurnsFromFaces[halfedge] = numbers.TurnFromFace;
  }

private:
  double Turn(int halfedge) const { return this->Turns.empty() ? 0.0 : this->Turns[halfedge]; }
  void SetCorners(const FramedMesh& surface, const ExecutionContext& context);
  void SetPolarAngles(const FramedMesh& surface, int vertex);

  Unfilled<double> PolarAngles;     // per halfedge
  Unfilled<double> CornerAngles;    // per halfedge
  Unfilled<Complex> TurnsFromFaces; // per halfedge
  std::vector<double> Turns;        // per halfedge, besides the surface's own transport; empty: none
};

}

#endif
