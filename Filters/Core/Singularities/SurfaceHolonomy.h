#ifndef dmgSurfaceHolonomy_h
#define dmgSurfaceHolonomy_h

#include "Analysis/TreeCotree.h"
#include "Mesh/FramedMesh.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <vector>

namespace dmg
{

/// The holonomy of parallel transport, that is its rotation along closed paths: around each vertex, and along homology
/// generators. These paths span all others; see TrivialConnection.h.
struct SurfaceHolonomy
{
  TreeCotree Trees;
  SparseMatrix<double> Loops;     ///< GeneratorsOverFaces
  Unfilled<Complex> Sides;        ///< SideDirections
  Vector<double> Defects;         ///< AngleDefects
  Vector<double> AlongGenerators; ///< RotationOfTransport

  std::vector<int> Components;    ///< by vertex
  std::vector<int> FirstVertices; ///< by component
  std::vector<char> AreClosed;    ///< by component

  /// Cost: O(#F), and the length of the loops.
  SurfaceHolonomy(const FramedMesh& surface, const ExecutionContext& context);

  int NumberOfGenerators() const { return static_cast<int>(this->Loops.cols()); }
  int NumberOfComponents() const { return static_cast<int>(this->FirstVertices.size()); }

  /// \param times N times the index of every vertex.
  /// \param names says how messages call vertices.
  /// \throw InvalidInput the indices on a closed component do not sum to its Euler characteristic; the message says how much
  ///   is missing.
  void CheckSums(const std::vector<int>& times, int N, const ElementNames& names) const;
};

}

#endif
