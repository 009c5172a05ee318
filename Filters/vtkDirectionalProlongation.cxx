#include "vtkDirectionalProlongation.h"

#include "Adapters/Pipeline/FilterOutputs.h"
#include "Adapters/Pipeline/PropertyTable.h"
#include "Adapters/Surface/MeshFromDataSet.h"
#include "Adapters/Surface/OperatorsToFieldData.h"
#include "Adapters/Surface/PolygonsFromDataSet.h"
#include "Adapters/Surface/PreparationToFieldData.h"
#include "StructurePreserving/SurfaceHierarchy.h"

#include "vtkCompositeDataSet.h"
#include "vtkDataSet.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationStringKey.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPolyData.h"

#include <string>
#include <vector>

vtkStandardNewMacro(vtkDirectionalProlongation);

//------------------------------------------------------------------------------
class vtkDirectionalProlongation::vtkInternals
{
public:
  /// The result of the last complete set-up.
  struct Setup
  {
    dmg::OperatorsOrigin Origin;
    dmg::PreparationReport Preparation;
    vtkNew<vtkFieldData> Operators;
    std::vector<vtkSmartPointer<vtkPolyData>> CoarseLevels;
  };

  std::unique_ptr<Setup> Last;
  int NumberOfSetups = 0;

  /// Builds anew only if the surface or the options are others than last time.
  void SetUp(vtkDataSet* surface, const dmg::PreparationOptions& preparation, const dmg::HierarchyOptions& options,
    const dmg::OperatorSelection& selection, const dmg::ExecutionContext& context)
  {
    const dmg::OperatorsOrigin origin{ dmg::ContentDigest(surface, preparation), options, selection };
    if (this->Last && this->Last->Origin == origin)
    {
      return;
    }
    const dmg::SurfaceMesh mesh = dmg::MeshFromDataSet(surface, preparation, context);
    const dmg::SurfaceHierarchy hierarchy = dmg::BuildSurfaceHierarchy(mesh.Mesh, options, context, selection);
    auto setup = std::make_unique<Setup>();
    setup->Origin = origin;
    setup->Preparation = mesh.Report;
    dmg::OperatorsToFieldData(hierarchy.Operators, origin, setup->Operators);
    if (!mesh.IsOneToOne())
    {
      dmg::RelationToFieldData(mesh, mesh.Mesh, setup->Operators);
    }
    for (const dmg::TriangleMesh& level : hierarchy.CoarseLevels)
    {
      setup->CoarseLevels.push_back(dmg::PolyDataFromMesh(level));
    }
    this->Last = std::move(setup);
    ++this->NumberOfSetups;
  }
};

//------------------------------------------------------------------------------
vtkDirectionalProlongation::vtkDirectionalProlongation()
  : Internals(new vtkInternals)
{
  const dmg::HierarchyOptions options;
  this->FaceRatio = options.FaceRatio;
  this->MaximumNumberOfCoarseLevels = options.MaximumNumberOfCoarseLevels;
  this->MinimumNumberOfFaces = options.MinimumNumberOfFaces;
  this->CollapsePolicy = static_cast<int>(options.Policy);
  this->Construction = static_cast<int>(options.Construction);
  this->SetNumberOfOutputPorts(2);
}

//------------------------------------------------------------------------------
vtkDirectionalProlongation::~vtkDirectionalProlongation() = default;

//------------------------------------------------------------------------------
int vtkDirectionalProlongation::GetNumberOfSetups() const
{
  return this->Internals->NumberOfSetups;
}

//------------------------------------------------------------------------------
int vtkDirectionalProlongation::FillOutputPortInformation(int port, vtkInformation* information)
{
  information->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkDataSet" : "vtkPartitionedDataSetCollection");
  return 1;
}

//------------------------------------------------------------------------------
dmg::PropertyTable vtkDirectionalProlongation::Properties() const
{
  dmg::PropertyTable table;
  table.Number("FaceRatio", this->FaceRatio, 0.05, 0.9);
  table.Number("MaximumNumberOfCoarseLevels", this->MaximumNumberOfCoarseLevels, 0, 20);
  table.Number("MinimumNumberOfFaces", this->MinimumNumberOfFaces, 4);
  table.Choice("CollapsePolicy", this->CollapsePolicy, { "IndependentRounds", "SequentialQueue" });
  table.Choice("Construction", this->Construction, { "TrackedPaths", "ExactOverlay" });
  table.Switch("PowerFields", this->PowerFields);
  table.Switch("FaceFields", this->FaceFields);
  table.Switch("OneForms", this->OneForms);
  return table;
}

//------------------------------------------------------------------------------
int vtkDirectionalProlongation::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkDataSet* const output = vtkDataSet::GetData(outputVector, 0);
  auto* const levels = vtkPartitionedDataSetCollection::GetData(outputVector, 1);
  const auto make = [this, output, levels](vtkInformationVector** whole, const dmg::ExecutionContext& context)
  {
    this->Properties().Check();
    dmg::HierarchyOptions options;
    options.FaceRatio = this->FaceRatio;
    options.MaximumNumberOfCoarseLevels = this->MaximumNumberOfCoarseLevels;
    options.MinimumNumberOfFaces = this->MinimumNumberOfFaces;
    options.Policy = static_cast<dmg::CollapsePolicy>(this->CollapsePolicy);
    options.Construction = static_cast<dmg::ProlongationConstruction>(this->Construction);
    const vtkSmartPointer<vtkDataSet> input = dmg::SurfaceOf(whole[0]);
    // Operators are in the frames of the caller's cells.
    const dmg::PreparationOptions preparation{ dmg::Numbering::AsGiven, this->JoinPoints, this->Strict, true };
    this->Internals->SetUp(
      input, preparation, options, { this->PowerFields, this->FaceFields, this->OneForms }, context);

    const vtkInternals::Setup& setup = *this->Internals->Last;
    output->ShallowCopy(input);
    dmg::RemoveOperators(output->GetFieldData());
    dmg::AddPreparation(setup.Preparation, preparation, output->GetFieldData());
    dmg::WarnOfPreparation(this, setup.Preparation);
    for (int i = 0; i < setup.Operators->GetNumberOfArrays(); ++i) // copies, which may be changed in place
    {
      vtkAbstractArray* const kept = setup.Operators->GetAbstractArray(i);
      const auto copy = vtk::TakeSmartPointer(kept->NewInstance());
      copy->DeepCopy(kept);
      output->GetFieldData()->AddArray(copy);
    }
    const auto finest = vtk::TakeSmartPointer(input->NewInstance());
    finest->ShallowCopy(input);
    const unsigned int numberOfLevels = 1 + static_cast<unsigned int>(setup.CoarseLevels.size());
    levels->SetNumberOfPartitionedDataSets(numberOfLevels);
    for (unsigned int level = 0; level < numberOfLevels; ++level)
    {
      levels->SetPartition(
        level, 0, level == 0 ? finest.Get() : static_cast<vtkDataSet*>(setup.CoarseLevels[level - 1].Get()));
      levels->GetMetaData(level)->Set(vtkCompositeDataSet::NAME(), "Level " + std::to_string(level));
    }
  };
  return dmg::MakeOutputs(this, request, inputVector, outputVector, make);
}

//------------------------------------------------------------------------------
void vtkDirectionalProlongation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  this->Properties().Print(os, indent);
  os << indent << "NumberOfSetups: " << this->GetNumberOfSetups() << "\n";
}
