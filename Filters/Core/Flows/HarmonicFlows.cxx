#include "Flows/HarmonicFlows.h"

#include "Analysis/HarmonicBasis.h"
#include "Analysis/HarmonicForms.h"
#include "Support/ComplexPairs.h"

#include <Eigen/QR>

#include <utility>

namespace dmg
{
namespace
{

constexpr Complex QuarterTurn(0.0, 1.0);
/// The basis is made once, and all harmonic parts rest on it.
const StoppingCriteria StopOfBasis{ 1e-12, 200 };

Vector<Complex> FlowOf(const Eigen::MatrixXd& fields, int k)
{
  const Vector<double> field = fields.col(k);
  return AsComplex(field);
}

/// Closed 1-forms less the gradients next to them: one for each homology generator, none of which crosses the boundary.
Eigen::MatrixXd FlowsAlongBoundary(FlowPotentials& potentials, const ExecutionContext& context)
{
  const FramedMesh& surface = potentials.Surface();
  potentials.CheckNumber(NumberOfGenerators(surface.Mesh), " loops around its handles and holes");
  const Eigen::MatrixXd forms = ClosedForms(surface.Mesh, context);
  Eigen::MatrixXd fields(2 * surface.Mesh.NumberOfFaces(), forms.cols());
  for (int k = 0; k < forms.cols(); ++k)
  {
    const double step = 1.0 / static_cast<double>(forms.cols());
    const PartOfContext part(context, step * k, step * (k + 1));
    Vector<Complex> field = FlowOfForm(surface, forms.col(k), part);
    const FlowDerivatives derivatives = IntegratedDerivatives(surface, field, part);
    field -= GradientOnFaces(surface, potentials.Potential(derivatives, FlowBoundary::Closed, StopOfBasis, part), part);
    fields.col(k) = AsPairs(field);
  }
  return fields;
}

/// The combinations of these through which nothing flows from one loop to another.
Eigen::MatrixXd WithoutTransports(
  const Eigen::MatrixXd& fields, FlowPotentials& potentials, const ExecutionContext& context)
{
  const Eigen::MatrixXd& functions = potentials.FunctionsOfLoops(context);
  if (functions.cols() == 0)
  {
    return fields;
  }
  Eigen::MatrixXd transports(fields.cols(), functions.cols());
  for (int k = 0; k < fields.cols(); ++k)
  {
    const FlowDerivatives derivatives = IntegratedDerivatives(potentials.Surface(), FlowOf(fields, k), context);
    transports.row(k) = (functions.transpose() * derivatives.Vorticity).transpose();
  }
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(transports);
  const Eigen::MatrixXd Q = qr.householderQ() * Eigen::MatrixXd::Identity(fields.cols(), fields.cols());
  return fields * Q.rightCols(fields.cols() - functions.cols());
}

}

Eigen::MatrixXd HarmonicFlows(FlowPotentials& potentials, FlowBoundary boundary, const ExecutionContext& context)
{
  const TriangleMesh& mesh = potentials.Surface().Mesh;
  Eigen::MatrixXd fields(2 * mesh.NumberOfFaces(), 0);
  if (NumberOfGenerators(mesh) > 0)
  {
    fields = FlowsAlongBoundary(potentials, PartOfContext(context, 0.0, 0.8));
    if (boundary == FlowBoundary::Closed)
    {
      fields = WithoutTransports(fields, potentials, PartOfContext(context, 0.8, 0.9));
    }
    for (int k = 0; k < fields.cols() && boundary == FlowBoundary::Open; ++k)
    {
      const Vector<Complex> turned = QuarterTurn * FlowOf(fields, k);
      fields.col(k) = AsPairs(turned);
    }
  }
  return HarmonicBasisOfFaceFields(mesh, std::move(fields), PartOfContext(context, 0.9, 1.0));
}

}
