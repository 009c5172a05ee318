#ifndef dmgLocalProlongation_h
#define dmgLocalProlongation_h

#include "StructurePreserving/Decimation/CollapseRecord.h"

#include <utility>
#include <vector>

namespace dmg
{

/// A row of a local operator, which gives a value before a collapse from values after it. All
/// elements go by their slots in the CollapsibleMesh.
template <class Scalar>
struct LocalRow
{
  int Before;
  std::vector<std::pair<int, Scalar>> Entries; ///< {after, coefficient}, none zero
};

/// The operators of one collapse, from the exact overlay of its one-ring. An element without a row keeps
/// its value. Coefficients are computed in rational numbers and rounded once, all but those of Powers.
/// Thesis, chapter 4.
struct LocalProlongation
{
  /// S0: the inner vertices in barycentric coordinates of the sectors.
  std::vector<LocalRow<double>> Vertices;

  /// S1, between values along halfedges: the Whitney forms of the sectors integrated along the
  /// edges inside the ring; sides of the polygon keep their values. Where the values of the two
  /// halfedges of an edge differ, as those of face fields do, an edge along a spoke takes the value
  /// on its own side: this is also S_h of the thesis.
  std::vector<LocalRow<double>> Halfedges;

  /// Q S_h, between face fields as sums to zero of values along the halfedges of a face: as above,
  /// and then the sum over each face is taken off again, in equal parts from its sides inside the
  /// ring. These are two of a face at the polygon, whose outer side must fit the neighbour (Q_B),
  /// all three of others (Q_I). Values that sum to zero do not change. Thesis, section 4.3.
  std::vector<LocalRow<double>> ZeroSumHalfedges;

  /// SP: directions of faces, each in a frame whose X is the direction of the first side, in space.
  /// Entries as in TransportOperator: the weight is the share of the pieces of the face's sides on
  /// the sector, by length in space after the collapse; the turn their mean rotation. Thesis,
  /// section 4.4, with unit directions and length weights.
  std::vector<LocalRow<Complex>> Powers;

  explicit LocalProlongation(const CollapseRecord& collapse);
};

}

#endif
