#include "Analysis/HarmonicBasis.h"

#include "Operators/ExteriorCalculus.h"
#include "Operators/FaceFieldOperators.h"
#include "Support/Errors.h"
#include "Support/Remedy.h"
#include "Support/Types.h"

#include <Eigen/Cholesky>

namespace dmg
{

namespace
{

/// Upper triangle of F^T diag(mass) F.
Eigen::MatrixXd GramMatrix(const Eigen::MatrixXd& fields, const Vector<double>& mass, const ExecutionContext& context)
{
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(fields.cols(), fields.cols());
  for (int k = 0; k < fields.cols(); ++k)
  {
    context.Checkpoint(static_cast<double>(k) / fields.cols());
    const Vector<double> weighted = mass.cwiseProduct(fields.col(k));
    gram.col(k).head(k + 1) = fields.leftCols(k + 1).transpose() * weighted;
  }
  return gram;
}

/// Multiplies columns by R^-1, R an upper triangle.
void DivideBy(const Eigen::MatrixXd& R, Eigen::MatrixXd& columns, const ExecutionContext& context)
{
  for (int k = 0; k < columns.cols(); ++k)
  {
    context.Checkpoint(static_cast<double>(k) / columns.cols());
    columns.col(k) -= columns.leftCols(k) * R.col(k).head(k);
    columns.col(k) /= R(k, k);
  }
}

/// Makes the columns of \p fields, 2 #F, orthonormal in the integral, by combinations with those
/// before them.
/// \param forms get the same combinations, if not null.
void MakeOrthonormal(
  const TriangleMesh& mesh, Eigen::MatrixXd& fields, Eigen::MatrixXd* forms, const ExecutionContext& context)
{
  if (fields.cols() == 0)
  {
    return;
  }
  const Vector<double> mass = MassesOfFaceFields(mesh).Faces;
  // The first pass leaves rounding times the condition of the Gram matrix; after the second one it
  // is rounding.
  constexpr int Passes = 2;
  for (int pass = 0; pass < Passes; ++pass)
  {
    const PartOfContext part(context, static_cast<double>(pass) / Passes, static_cast<double>(pass + 1) / Passes);
    const Eigen::LLT<Eigen::MatrixXd, Eigen::Upper> factor(GramMatrix(fields, mass, PartOfContext(part, 0.0, 0.4)));
    if (factor.info() != Eigen::Success)
    {
      throw SolverFailure("the harmonic fields of the surface cannot be told apart by their vectors "
                          "on faces with an area; " +
        TextOf(Remedy::DropWithoutArea));
    }
    const Eigen::MatrixXd R = factor.matrixU();
    DivideBy(R, fields, PartOfContext(part, 0.4, 0.8));
    if (forms)
    {
      DivideBy(R, *forms, PartOfContext(part, 0.8, 1.0));
    }
  }
  context.Checkpoint(1.0);
}

}

Eigen::MatrixXd HarmonicBasisOfForms(
  const TriangleMesh& mesh, const TangentFrames& faceFrames, Eigen::MatrixXd forms, const ExecutionContext& context)
{
  Eigen::MatrixXd fields(2 * mesh.NumberOfFaces(), forms.cols());
  for (int k = 0; k < forms.cols(); ++k)
  {
    context.Checkpoint(0.2 * k / forms.cols());
    fields.col(k) = FaceFieldFromVectors(faceFrames, WhitneyAtFaces(mesh, forms.col(k), context));
  }
  MakeOrthonormal(mesh, fields, &forms, PartOfContext(context, 0.2, 1.0));
  return forms;
}

Eigen::MatrixXd HarmonicBasisOfFaceFields(
  const TriangleMesh& mesh, Eigen::MatrixXd fields, const ExecutionContext& context)
{
  MakeOrthonormal(mesh, fields, nullptr, context);
  return fields;
}

}
