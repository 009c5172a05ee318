#ifndef dmgOneFormSystem_h
#define dmgOneFormSystem_h

#include "Mesh/TriangleMesh.h"
#include "Operators/ExteriorCalculus.h"
#include "Support/ExecutionContext.h"
#include "Systems/HarmonicSystem.h"
#include "Systems/OneFormConstraints.h"

namespace dmg
{

/// The system of the most harmonic 1-form that follows prescribed values on edges; unknowns are the
/// values of the edges:
///   argmin  lambda_S h^T L1 h + lambda_A sum_b w_b m_b |h_b - y_b|^2   (soft)
///   argmin  h^T L1 h  subject to  h_b = y_b                            (hard)
/// with L1 = OneFormLaplacian and the positive mass m = PositiveStar1 / (2 mean A), A the areas of
/// the faces. So a prescribed region pulls as hard, by its area, as the same region on a power
/// field with the same weights: the power energy is twice the Dirichlet energy, h^T L1 h is not.
/// The mass M for errors is PositiveStar1. Thesis, section 6.1, as corrected: its alignment term
/// aims at half the values, and its mass, the cotangents, may be negative.
///
/// The field flows along a boundary, not across it: that is what the natural conditions of L1 ask.
/// The kernel of L1 has dimension 2g on a closed surface of genus g (2g + b - 1 with b boundary
/// loops). The matrix is as definite as the prescribed edges make it, which takes as many of them:
/// one face fixes two harmonic forms, so genus 2 needs two faces at least. Components of the
/// surface without a prescribed edge get the zero field.
/// \throw InvalidInput a weight is out of range, nothing is prescribed, or hard constraints leave
/// nothing to solve for.
/// \pre prescribed edges are ascending and in range; see OneFormConstraints.h.
/// \param areas the star of 0-forms.
/// Cost: O(#E).
HarmonicSystem<double> MakeOneFormSystem(const TriangleMesh& mesh,
  const PrescribedEdges& prescribed, const FieldWeights& weights,
  const ExecutionContext& context = SerialContext(),
  VertexAreas areas = VertexAreas::MixedVoronoi);

/// What is prescribed there, as the system takes it. Errors as above.
PrescribedUnknowns PrescribedUnknownsOf(
  const TriangleMesh& mesh, const PrescribedEdges& prescribed, const FieldWeights& weights);

}

#endif
