#include "Flows/HarmonicFlows.h"

#include "Analysis/HarmonicBasis.h"
#include "Analysis/HarmonicForms.h"
#include "Support/ComplexPairs.h"

#include <Eigen/QR>

#include <cstddef>
#include <utility>
#include <vector>

namespace dmg
{
namespace
{

/// The basis is made once, and all harmonic parts rest on it.
const StoppingCriteria StopOfBasis{ 1e-12, 200 };

Vector<Complex> FlowOf(const Eigen::MatrixXd& fields, int k)
{
  const Vector<double> field = fields.col(k);
  return AsComplex(field);
}

/// The combinations of n things for which all conditions are zero, n x their number. \param conditions a column each, independent.
Eigen::MatrixXd KernelOf(const Eigen::MatrixXd& conditions)
{
  const Eigen::Index size = conditions.rows();
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(conditions);
  const Eigen::MatrixXd Q = qr.householderQ() * Eigen::MatrixXd::Identity(size, size);
  return Q.rightCols(size - conditions.cols());
}

/// Sets the integrals of a form along a part of the boundary, from its first vertex to each.
/// \return that along all of a loop.
double IntegrateAlong(
  const BoundaryPart& part, const TriangleMesh& mesh, const Vector<double>& form, Vector<double>& at)
{
  double sum = 0.0;
  for (const int vertex : part.Vertices)
  {
    at[vertex] = sum;
    const int h = mesh.OutgoingHalfedge(vertex);
    sum += mesh.EdgeSign(h) * form[mesh.EdgeOf(h)];
  }
  return sum;
}

/// The open loops of the boundary around which integrals of closed forms are independent: all, but the first of a component that has no
/// other boundary.
std::vector<const BoundaryPart*> IndependentOpenLoops(const std::vector<BoundaryPart>& parts)
{
  std::vector<const BoundaryPart*> loops;
  for (std::size_t first = 0, last = 0; first < parts.size(); first = last)
  {
    bool areAll = true;
    for (last = first; last < parts.size() && parts[last].Component == parts[first].Component; ++last)
    {
      areAll &= parts[last].IsOpen && parts[last].IsLoop;
    }
    for (std::size_t k = areAll ? first + 1 : first; k < last; ++k)
    {
      if (parts[k].IsOpen && parts[k].IsLoop)
      {
        loops.push_back(&parts[k]);
      }
    }
  }
  return loops;
}

/// The combinations of closed forms that have no integral around any open loop, so that they are differences along it.
Eigen::MatrixXd WithoutPeriods(
  Eigen::MatrixXd forms, const std::vector<const BoundaryPart*>& loops, const TriangleMesh& mesh)
{
  if (loops.empty())
  {
    return forms;
  }
  Vector<double> along(mesh.NumberOfVertices());
  Eigen::MatrixXd periods(forms.cols(), static_cast<Eigen::Index>(loops.size()));
  for (Eigen::Index k = 0; k < forms.cols(); ++k)
  {
    for (Eigen::Index loop = 0; loop < periods.cols(); ++loop)
    {
      periods(k, loop) = IntegrateAlong(*loops[loop], mesh, forms.col(k), along);
    }
  }
  return forms * KernelOf(periods);
}

/// Gradients of the harmonic functions that are 1 on one open part of the boundary and 0 on the others.
Eigen::MatrixXd FlowsBetweenOpenParts(FlowPotentials& potentials, const ExecutionContext& context)
{
  const FramedMesh& surface = potentials.Surface();
  const Eigen::MatrixXd functions = potentials.FunctionsOfOpenParts(context);
  Eigen::MatrixXd fields(2 * surface.Mesh.NumberOfFaces(), functions.cols());
  for (Eigen::Index k = 0; k < functions.cols(); ++k)
  {
    const Vector<Complex> gradient = GradientOnFaces(surface, functions.col(k), context);
    fields.col(k) = AsPairs(gradient);
  }
  return fields;
}

/// Closed 1-forms less the gradients next to them, for which nothing is left along open parts of the boundary.
Eigen::MatrixXd FlowsOfForms(FlowPotentials& potentials, const ExecutionContext& context)
{
  const FramedMesh& surface = potentials.Surface();
  potentials.CheckNumber(NumberOfGenerators(surface.Mesh), " loops around its handles and holes");
  const Eigen::MatrixXd forms =
    WithoutPeriods(ClosedForms(surface.Mesh, context), IndependentOpenLoops(potentials.Parts()), surface.Mesh);
  Eigen::MatrixXd fields(2 * surface.Mesh.NumberOfFaces(), forms.cols());
  for (int k = 0; k < forms.cols(); ++k)
  {
    const double step = 1.0 / static_cast<double>(forms.cols());
    const PartOfContext part(context, step * k, step * (k + 1));
    Vector<double> along = Vector<double>::Zero(surface.Mesh.NumberOfVertices());
    for (const BoundaryPart& each : potentials.Parts())
    {
      if (each.IsOpen)
      {
        IntegrateAlong(each, surface.Mesh, forms.col(k), along);
      }
    }
    Vector<Complex> field = FlowOfForm(surface, forms.col(k), part);
    const FlowDerivatives derivatives = IntegratedDerivatives(surface, field, part);
    field -= GradientOnFaces(surface, potentials.Potential(derivatives, StopOfBasis, part, along), part);
    fields.col(k) = AsPairs(field);
  }
  return fields;
}

/// The combinations of these that have no circulation along any coast.
Eigen::MatrixXd WithoutCirculations(Eigen::MatrixXd fields, FlowPotentials& potentials, const ExecutionContext& context)
{
  const Eigen::MatrixXd& functions = potentials.FunctionsOfCoasts(context);
  if (functions.cols() == 0)
  {
    return fields;
  }
  Eigen::MatrixXd circulations(fields.cols(), functions.cols());
  for (int k = 0; k < fields.cols(); ++k)
  {
    const FlowDerivatives derivatives = IntegratedDerivatives(potentials.Surface(), FlowOf(fields, k), context);
    circulations.row(k) = (functions.transpose() * derivatives.Vorticity).transpose();
  }
  return fields * KernelOf(circulations);
}

}

Eigen::MatrixXd HarmonicFlows(FlowPotentials& potentials, const ExecutionContext& context)
{
  const TriangleMesh& mesh = potentials.Surface().Mesh;
  const Eigen::MatrixXd between = FlowsBetweenOpenParts(potentials, PartOfContext(context, 0.0, 0.3));
  Eigen::MatrixXd fields = between;
  if (NumberOfGenerators(mesh) > 0)
  {
    const Eigen::MatrixXd ofForms = FlowsOfForms(potentials, PartOfContext(context, 0.3, 0.8));
    fields.resize(between.rows(), between.cols() + ofForms.cols());
    fields << between, ofForms;
  }
  fields = WithoutCirculations(std::move(fields), potentials, PartOfContext(context, 0.8, 0.9));
  return HarmonicBasisOfFaceFields(mesh, std::move(fields), PartOfContext(context, 0.9, 1.0));
}

}
