#include "Adapters/Output/ScalesToArrays.h"

#include "Adapters/Input/FlowFromArrays.h"
#include "Adapters/Output/SpectrumToTable.h"
#include "Adapters/Surface/ElementArrays.h"
#include "Mesh/SurfaceSizes.h"
#include "Support/ComplexPairs.h"
#include "Support/ShortText.h"

#include "vtkCellData.h"
#include "vtkPointData.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dmg
{
namespace
{

/// The parts of the progress of a stage that makes a set-up, unless there is one, and then solves.
PartOfContext SetupPart(const ExecutionContext& context)
{
  return PartOfContext(context, 0.0, 0.3);
}

PartOfContext SolvePart(const ExecutionContext& context)
{
  return PartOfContext(context, 0.3, 1.0);
}

/// Spectra are drawn, and their rows sum to the whole at any tolerance.
constexpr double ToleranceOfSpectra = 1e-4;
constexpr int MostIterations = 200;
constexpr double CellsOfDefault = 10.0;

/// Two digits, which names of arrays show.
double Rounded(double x)
{
  const double unit = std::pow(10.0, std::floor(std::log10(x)) - 1.0);
  return std::stod(ShortText(std::round(x / unit) * unit));
}

/// One call of AddScales.
class Run
{
public:
  Run(ScaleSurface& of, const ScaleOptions& options, const SurfaceView& view, const SurfaceSizes& sizes,
    const ExecutionContext& context)
    : Of(of)
    , Options(options)
    , View(view)
    , On(of.On())
    , Sizes(sizes)
    , Context(context)
  {
    if (this->Options.Wavelengths.empty())
    {
      const bool varies = !of.Given().RelativeWavelengths.empty();
      this->Options.Wavelengths = {
        varies ? 1.0 : Rounded(CellsOfDefault * this->UnitOfWavelengths() * this->Sizes.MeanEdge)
      };
    }
  }

  void Read(const QuantityArrays& quantities, const ExecutionContext& context);
  void AddWavelength(double wavelength, const ExecutionContext& context);
  void AddSpectra(vtkTable* table, const ExecutionContext& context);
  void AddReport() const;

  const std::vector<double>& Wavelengths() const { return this->Options.Wavelengths; }

  std::vector<ReadFunction> Functions;
  std::vector<ReadFlow> Flows;
  std::vector<std::string> Warnings;

private:
  void AddFunction(const ReadFunction& function, double wavelength, const ExecutionContext& context);
  void AddFlow(const ReadFlow& flow, double wavelength, const ExecutionContext& context);
  void AddVectors(const ReadFlow& flow, double wavelength, const ExecutionContext& context);
  /// Writes a flow below, and the rest of the given one above.
  void WriteFlow(const ReadFlow& flow, const std::string& at, const Vector<Complex>& below) const;
  void WritePart(const ReadFlow& flow, const std::string& name, const Vector<Complex>& onFaces) const;
  Vector<Complex> AtVertices(const Vector<Complex>& onFaces) const;
  void Take(const SolveReport& report);
  StoppingCriteria Stop() const { return { this->Options.Tolerance, MostIterations }; }
  /// The wavelength of a length of the points; the middle one where wavelengths vary.
  double UnitOfWavelengths() const;

  ScaleSurface& Of;
  ScaleOptions Options;
  const SurfaceView& View;
  const FramedMesh& On;
  const SurfaceSizes Sizes;
  const ExecutionContext& Context;
  std::vector<double> MeansBefore, MeansAfter; ///< of the functions at each wavelength
  std::vector<int> Iterations;                 ///< of all splits
  bool HaveConverged = true;
};

Vector<Complex> Run::AtVertices(const Vector<Complex>& onFaces) const
{
  return this->Of.AtVertices(onFaces, this->Context);
}

void Run::Read(const QuantityArrays& quantities, const ExecutionContext& context)
{
  for (const ChosenArray& array : quantities.Functions)
  {
    ReadFunction function{ array.Name, array.OnPoints(), this->View.Numbers(array), {} };
    function.AtVertices = function.IsOnPoints ? function.Given : FunctionOfFaces(this->On.Mesh, function.Given);
    this->Functions.push_back(std::move(function));
  }
  const double step = 1.0 / std::max<double>(1.0, static_cast<double>(quantities.Flows.size()));
  double done = 0.0;
  for (const NamedFlowArrays& each : quantities.Flows)
  {
    const PartOfContext part(context, done, done + step);
    done += step;
    ReadFlow flow{ each.Name, each.Arrays.AreOnPoints(),
      FlowFromArrays(this->View, each.Arrays, PartOfContext(part, 0.0, 0.1)).Tangential };
    const Vector<Complex> onFaces = flow.Given;
    VectorsOnSurface vectors = this->View.Vectors(each.Arrays);
    vectors.TakeOutNormalParts(this->View.Mesh(), this->View.Relation());
    flow.Given.resize(vectors.Values.rows());
    const TangentFrames& frames = vectors.AreAtVertices ? this->On.Vertices : this->On.Faces;
    for (int element = 0; element < flow.Given.size(); ++element)
    {
      flow.Given[element] = frames.ToComplex(element, vectors.Values.row(element).transpose());
    }
    if (this->Options.AreWholes)
    {
      flow.AtVertices = AsPairs(flow.IsOnPoints ? flow.Given : this->AtVertices(onFaces));
    }
    else
    {
      this->Of.OfFlows(PartOfContext(part, 0.1, 0.5)); // which shares its set-up
      flow.Parts =
        this->Of.Decomposition().Decompose(onFaces, {}, { 1e-11, MostIterations }, PartOfContext(part, 0.5, 1.0));
      this->Warnings.insert(this->Warnings.end(), flow.Parts.Warnings.begin(), flow.Parts.Warnings.end());
      this->HaveConverged &= flow.Parts.Converged;
    }
    this->Flows.push_back(std::move(flow));
  }
}

void Run::Take(const SolveReport& report)
{
  this->Of.CountSplits(1);
  this->HaveConverged &= report.Converged || report.EndedByRounding;
  this->Iterations.push_back(report.Iterations.empty() ? 0 : report.Iterations.back().Iteration);
  this->Warnings.insert(this->Warnings.end(), report.Warnings.begin(), report.Warnings.end());
}

double Run::UnitOfWavelengths() const
{
  std::vector<double> relative = this->Of.Given().RelativeWavelengths;
  if (relative.empty())
  {
    return this->Of.Given().LengthScale;
  }
  const auto middle = relative.begin() + static_cast<std::ptrdiff_t>(relative.size() / 2);
  std::nth_element(relative.begin(), middle, relative.end());
  return this->Of.Given().LengthScale / *middle;
}

void Run::AddFunction(const ReadFunction& function, double wavelength, const ExecutionContext& context)
{
  ScaleFilter& scales = this->Of.OfFunctions(SetupPart(context));
  const SplitScales split = scales.Split(function.AtVertices, wavelength, this->Stop(), SolvePart(context));
  this->Take(scales.Report());
  this->MeansBefore.push_back(scales.Mean(function.AtVertices));
  this->MeansAfter.push_back(scales.Mean(split.Below));
  const std::string below = ArrayNames::BelowWavelength(function.Name, ShortText(wavelength));
  const std::string above = ArrayNames::AboveWavelength(function.Name, ShortText(wavelength));
  if (function.IsOnPoints)
  {
    this->View.OfPoints(this->Context).Add(below, 1, split.Below.data());
    this->View.OfPoints(this->Context).Add(above, 1, split.Above.data());
    return;
  }
  const Vector<double> onFaces = MeansOfFaces(this->On.Mesh, split.Below);
  const Vector<double> rest = function.Given - onFaces;
  this->View.OfCells(this->Context).Add(below, 1, onFaces.data());
  this->View.OfCells(this->Context).Add(above, 1, rest.data());
}

void Run::WriteFlow(const ReadFlow& flow, const std::string& at, const Vector<Complex>& below) const
{
  const Vector<Complex> above = flow.Given - below;
  const auto write = [&](const std::string& name, const Vector<Complex>& field)
  {
    if (flow.IsOnPoints)
    {
      this->View.OfPoints(this->Context).AddVectors(name, this->On.Vertices, field);
    }
    else
    {
      this->View.OfCells(this->Context).AddVectors(name, this->On.Faces, field);
    }
  };
  write(ArrayNames::BelowWavelength(flow.Name, at), below);
  write(ArrayNames::AboveWavelength(flow.Name, at), above);
}

void Run::WritePart(const ReadFlow& flow, const std::string& name, const Vector<Complex>& onFaces) const
{
  if (flow.IsOnPoints)
  {
    this->View.OfPoints(this->Context).AddVectors(name, this->On.Vertices, this->AtVertices(onFaces));
  }
  else
  {
    this->View.OfCells(this->Context).AddVectors(name, this->On.Faces, onFaces);
  }
}

void Run::AddFlow(const ReadFlow& flow, double wavelength, const ExecutionContext& context)
{
  FlowScales& scales = this->Of.OfFlows(SetupPart(context));
  const SplitFlow split = scales.Split(flow.Parts, wavelength, this->Stop(), SolvePart(context));
  this->Take(scales.ReportOfPotential());
  this->Take(scales.ReportOfStreamFunction());
  const std::string at = ShortText(wavelength);
  this->WriteFlow(flow, at, flow.IsOnPoints ? this->AtVertices(split.Below) : split.Below);
  if (this->Options.PartsApart)
  {
    this->WritePart(flow, ArrayNames::BelowWavelength(flow.Name + " divergent", at), split.GradientBelow);
    this->WritePart(flow, ArrayNames::BelowWavelength(flow.Name + " rotational", at), split.RotationalBelow);
  }
}

void Run::AddVectors(const ReadFlow& flow, double wavelength, const ExecutionContext& context)
{
  ScaleFilter& scales = this->Of.OfVectors(SetupPart(context));
  const SplitScales split = scales.Split(flow.AtVertices, wavelength, this->Stop(), SolvePart(context));
  this->Take(scales.Report());
  const Vector<Complex> below = AsComplex(split.Below);
  if (flow.IsOnPoints)
  {
    this->WriteFlow(flow, ShortText(wavelength), below);
    return;
  }
  VectorsOnSurface inSpace{ true, Points(below.size(), 3) };
  for (int vertex = 0; vertex < below.size(); ++vertex)
  {
    inSpace.Values.row(vertex) = this->On.Vertices.ToVector(vertex, below[vertex]).transpose();
  }
  const Points means = inSpace.OnFaces(this->On.Mesh);
  Vector<Complex> onFaces(means.rows());
  for (int face = 0; face < onFaces.size(); ++face)
  {
    onFaces[face] = this->On.Faces.ToComplex(face, means.row(face).transpose());
  }
  this->WriteFlow(flow, ShortText(wavelength), onFaces);
}

void Run::AddWavelength(double wavelength, const ExecutionContext& context)
{
  const double step = 1.0 / static_cast<double>(this->Functions.size() + this->Flows.size());
  double done = 0.0;
  for (const ReadFunction& function : this->Functions)
  {
    this->AddFunction(function, wavelength, PartOfContext(context, done, done + step));
    done += step;
  }
  for (const ReadFlow& flow : this->Flows)
  {
    const PartOfContext part(context, done, done + step);
    this->Options.AreWholes ? this->AddVectors(flow, wavelength, part) : this->AddFlow(flow, wavelength, part);
    done += step;
  }
}

void Run::AddSpectra(vtkTable* table, const ExecutionContext& context)
{
  const double scale = this->UnitOfWavelengths();
  const double from =
    this->Options.SpectrumFrom > 0.0 ? this->Options.SpectrumFrom : 4.0 * this->Sizes.MeanEdge * scale;
  const double longest = std::max(2.0 * std::sqrt(this->Sizes.Area) * scale, 2.0 * from);
  const double to = this->Options.SpectrumTo > 0.0 ? this->Options.SpectrumTo : longest;
  const Vector<double> bounds = SpectrumBounds(from, to, this->Options.SpectrumRows);
  const StoppingCriteria stop{ ToleranceOfSpectra, MostIterations };
  SpectrumTable rows(table, this->Sizes.Area);
  const double share =
    static_cast<double>(this->Functions.size()) / static_cast<double>(this->Functions.size() + this->Flows.size());
  const auto find = [&](ScaleFilter& filter, const auto& all, const ExecutionContext& part)
  {
    std::vector<Vector<double>> quantities;
    std::transform(
      all.begin(), all.end(), std::back_inserter(quantities), [](const auto& each) { return each.AtVertices; });
    const std::vector<Spectrum> spectra = FindSpectra(filter, quantities, bounds, stop, part);
    for (std::size_t k = 0; k < all.size(); ++k)
    {
      rows.Add(all[k].Name, spectra[k]);
    }
    this->Of.CountSplits(static_cast<int>(all.size() * bounds.size()));
  };
  if (!this->Functions.empty())
  {
    const PartOfContext part(context, 0.0, share);
    find(this->Of.OfFunctions(SetupPart(part)), this->Functions, SolvePart(part));
  }
  if (this->Options.AreWholes && !this->Flows.empty())
  {
    const PartOfContext part(context, share, 1.0);
    find(this->Of.OfVectors(SetupPart(part)), this->Flows, SolvePart(part));
    return;
  }
  for (std::size_t k = 0; k < this->Flows.size(); ++k)
  {
    const double step = (1.0 - share) / static_cast<double>(this->Flows.size());
    const double done = share + static_cast<double>(k) * step;
    const ReadFlow& flow = this->Flows[k];
    const PartOfContext part(context, done, done + step);
    FlowScales& scales = this->Of.OfFlows(SetupPart(part));
    const FlowSpectra spectra = scales.FindSpectra(flow.Parts, bounds, stop, SolvePart(part));
    rows.Add(flow.Name, spectra.Flow);
    rows.Add(flow.Name + " divergent", spectra.Gradient);
    rows.Add(flow.Name + " rotational", spectra.Rotational);
    rows.AddHarmonic(flow.Name, flow.Parts.HarmonicEnergy);
    this->Of.CountSplits(static_cast<int>(2 * bounds.size()));
  }
}

void Run::AddReport() const
{
  vtkDataSet* const output = this->View.Output();
  vtkFieldData* const data = output->GetFieldData();
  const auto wavelengths = static_cast<int>(this->Options.Wavelengths.size());
  auto names = vtkSmartPointer<vtkStringArray>::New();
  names->SetName(ArrayNames::ScaledFunctions);
  for (const ReadFunction& function : this->Functions)
  {
    names->InsertNextValue(function.Name);
  }
  data->AddArray(names);
  data->AddArray(NewArray<vtkDoubleArray>(ArrayNames::Wavelengths, 1, this->Options.Wavelengths));
  // Splits come by wavelength; a tuple stands for a wavelength.
  data->AddArray(
    NewArray<vtkDoubleArray>(ArrayNames::MeansBefore, std::max<int>(1, this->Functions.size()), this->MeansBefore));
  data->AddArray(
    NewArray<vtkDoubleArray>(ArrayNames::MeansAfter, std::max<int>(1, this->Functions.size()), this->MeansAfter));
  data->AddArray(NewArray<vtkIntArray>(
    ArrayNames::Iterations, static_cast<int>(this->Iterations.size()) / wavelengths, this->Iterations));
  data->AddArray(NewValue<vtkIntArray>(ArrayNames::Converged, this->HaveConverged ? 1 : 0));
  const std::string at = ShortText(this->Options.Wavelengths.front());
  if (!this->Functions.empty())
  {
    const ReadFunction& first = this->Functions.front();
    vtkDataSetAttributes* const attributes =
      first.IsOnPoints ? static_cast<vtkDataSetAttributes*>(output->GetPointData()) : output->GetCellData();
    attributes->SetActiveScalars(ArrayNames::BelowWavelength(first.Name, at).c_str());
  }
}

std::vector<std::string> Finish(
  Run& run, const ScaleOptions& options, vtkTable* spectrum, const ExecutionContext& context)
{
  const double end = options.HasSpectrum ? 0.4 : 1.0;
  const double step = end / static_cast<double>(run.Wavelengths().size());
  double done = 0.0;
  for (const double wavelength : run.Wavelengths())
  {
    run.AddWavelength(wavelength, PartOfContext(context, done, done + step));
    done += step;
  }
  if (options.HasSpectrum)
  {
    run.AddSpectra(spectrum, PartOfContext(context, end, 1.0));
  }
  run.AddReport();
  context.Checkpoint(1.0);
  return run.Warnings;
}

}

std::vector<std::string> AddScales(ScaleSurface& surface, const QuantityArrays& quantities, const ScaleOptions& options,
  const SurfaceView& view, vtkTable* spectrum, const ExecutionContext& context)
{
  Run run(surface, options, view, SizesOf(surface.On().Mesh), context);
  run.Read(quantities, PartOfContext(context, 0.0, 0.2));
  return Finish(run, options, spectrum, PartOfContext(context, 0.2, 1.0));
}

std::vector<std::string> AddScales(ScaleSurface& surface, ReadQuantities quantities, const ScaleOptions& options,
  const SurfaceView& view, vtkTable* spectrum, const ExecutionContext& context)
{
  ScaleFilter& any = quantities.Functions.empty() ? surface.OfVectors(context) : surface.OfFunctions(context);
  Run run(surface, options, view, any.Sizes(), context);
  run.Functions = std::move(quantities.Functions);
  run.Flows = std::move(quantities.Flows);
  return Finish(run, options, spectrum, context);
}

}
