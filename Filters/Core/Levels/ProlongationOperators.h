#ifndef dmgProlongationOperators_h
#define dmgProlongationOperators_h

#include "Levels/TransportOperator.h"
#include "Support/Types.h"

#include <vector>

namespace dmg
{

/// The structure-preserving operators that a set-up builds beside S0 and Linear.
struct OperatorSelection
{
  bool PowerFields = true; ///< SP
  bool FaceFields = true;  ///< SX
  bool OneForms = true;    ///< S1

  /// Whether it has all that another one has.
  bool Includes(const OperatorSelection& other) const
  {
    return this->PowerFields >= other.PowerFields && this->FaceFields >= other.FaceFields &&
      this->OneForms >= other.OneForms;
  }
  void Add(const OperatorSelection& more)
  {
    this->PowerFields |= more.PowerFields;
    this->FaceFields |= more.FaceFields;
    this->OneForms |= more.OneForms;
  }
};

/// The prolongations between the levels of a hierarchy, which are all that solvers need of it.
///
/// Level 0 is the finest. Operator l of each list carries values from level l + 1 to level l.
/// The operators do not depend on N, on constraints or on weights.
struct ProlongationOperators
{
  /// Sizes of the levels, finest first; one more than there are operators in a list. Of a level of
  /// samples: the samples, which are the faces that are left as well as the vertices of the linear
  /// hierarchy, and the pairs of neighbours.
  std::vector<int> NumbersOfVertices;
  std::vector<int> NumbersOfEdges;
  std::vector<int> NumbersOfFaces;

  /// S0[l], #V_l x #V_{l+1}: 0-forms. Rows are non-negative and sum to 1. Thesis, section 3.5.
  std::vector<SparseMatrix<double>> S0;

  /// S1[l], #E_l x #E_{l+1}: 1-forms, in the orientations of the edges; d0 S0 = S1 d0. Thesis,
  /// section 4.2.
  std::vector<SparseMatrix<double>> S1;

  /// #E_L x (2 g + b - 1), L the coarsest level: its closed 1-forms that are no gradients, by integers, one per
  /// independent loop of the surface (HarmonicForms.h). S1[0] ... S1[L - 1] carries them to the finest. Made with S1;
  /// without columns where there is none, or the operators were stored.
  SparseMatrix<double> ClosedForms;

  /// SX[l], 2 #F_l x 2 #F_{l+1}: face fields, in FaceFrames. Thesis, section 4.3.
  std::vector<SparseMatrix<double>> SX;

  /// SP[l], #F_l x #F_{l+1}: power fields, face to face. Thesis, section 4.4.
  std::vector<TransportOperator> SP;

  /// The linear hierarchy: [0] is #F_0 x #V_1, face fields from directions at the vertices of
  /// level 1; [l >= 1] is #V_l x #V_{l+1}. Directions are in FaceFrames on level 0 and, above, in
  /// polar coordinates of the vertices (LinearProlongation.h) or in the FaceFrames of the faces that
  /// were sampled (SampledProlongation.h).
  std::vector<TransportOperator> Linear;
  /// Whether Linear[0] goes to the vertices of level 0, in VertexFrames, in place of its faces.
  bool IsLinearAtVertices = false;

  int NumberOfLevels() const { return static_cast<int>(this->NumbersOfFaces.size()); }
};

}

#endif
