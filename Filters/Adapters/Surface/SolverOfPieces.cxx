#include "Adapters/Surface/SolverOfPieces.h"

#include "Adapters/Ranks/NearPlaces.h"
#include "Adapters/Surface/SolverOfSurface.h"
#include "Analysis/BoundaryLoops.h"
#include "Support/Errors.h"
#include "Support/Stopwatch.h"

#include "vtkDataSet.h"

#include <algorithm>
#include <optional>
#include <unordered_map>
#include <utility>

namespace dmg
{

namespace
{

/// Whether the ranks of the pipeline are those of MPI_COMM_WORLD.
bool AreAllOfMpi(const RanksOfPipeline& ranks)
{
  int isInitialised = 0;
  MPI_Initialized(&isInitialised);
  int rank = -1;
  int size = 0;
  if (isInitialised != 0)
  {
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &size);
  }
  return ranks.AreAll(rank == ranks.Rank() && size == ranks.Size());
}

/// Moves points at the rims of pieces by some roundings to where ranks before this one have them: sources that compute the points of
/// each piece for themselves round them for themselves.
void AgreeOnSeams(const RanksOfPipeline& ranks, const TriangleMesh* mesh, double roundOff, Points& positions)
{
  const std::vector<int> rim = mesh ? BoundaryVertices(*mesh) : std::vector<int>();
  std::string here(rim.size() * sizeof(NearPlaces::Place), '\0');
  double largest = 0.0;
  for (std::size_t k = 0; k < rim.size(); ++k)
  {
    const NearPlaces::Place place{ positions(rim[k], 0), positions(rim[k], 1), positions(rim[k], 2) };
    std::copy_n(reinterpret_cast<const char*>(place.data()), sizeof(place), here.data() + k * sizeof(place));
  }
  const std::vector<std::string> rims = ranks.Gather(here);
  ranks.Together(
    [&]
    {
      std::vector<NearPlaces::Place> others;
      for (int rank = 0; rank < ranks.Rank(); ++rank)
      {
        const std::size_t former = others.size();
        others.resize(former + rims[rank].size() / sizeof(NearPlaces::Place));
        std::copy_n(rims[rank].data(), rims[rank].size(), reinterpret_cast<char*>(others.data() + former));
      }
      for (const auto& place : others)
      {
        for (const double coordinate : place)
        {
          largest = std::max(largest, std::abs(coordinate));
        }
      }
      const NearPlaces near(others, roundOff * largest);
      for (const int vertex : rim)
      {
        if (const int found = near.First({ positions(vertex, 0), positions(vertex, 1), positions(vertex, 2) });
            found >= 0)
        {
          for (int k = 0; k < 3; ++k)
          {
            positions(vertex, k) = others[found][k];
          }
        }
      }
    });
}

/// For each number of a list, the index of the first one that is equal.
std::vector<int> FirstsOf(const std::vector<int>& numbers)
{
  std::unordered_map<int, int> firsts;
  std::vector<int> indices;
  for (const int number : numbers)
  {
    indices.push_back(firsts.emplace(number, static_cast<int>(indices.size())).first->second);
  }
  return indices;
}

/// The mesh of this rank's piece, and the piece as the solver takes it; none where it has no cells. Collective.
std::optional<SurfaceMesh> MeshOfPiece(const RanksOfPipeline& ranks, vtkDataSet* input, PreparationOptions preparation,
  SurfacePiece& piece, const ExecutionContext& context)
{
  std::optional<SurfaceMesh> mesh;
  preparation.KeepsSides = true;
  ranks.Together(
    [&]
    {
      if (input->GetNumberOfCells() > 0)
      {
        mesh = MeshFromDataSet(input, preparation, context);
        piece.Positions = mesh->Mesh.VertexPositions();
        piece.Corners = mesh->Mesh.FaceCorners();
      }
    });
  return mesh;
}

}

std::string SolverOfPieces::SetSurface(const RanksOfPipeline& ranks, vtkDataSet* input,
  const PreparationOptions& preparation, const ExecutionContext& context)
{
  const bool isEmpty = input->GetNumberOfCells() == 0;
  std::string digest;
  ranks.Together([&] { digest = isEmpty ? "none" : ContentDigest(input, preparation); });
  if (ranks.AreAll(digest == this->Digest))
  {
    return this->Reason;
  }
  this->FormerCounts = this->Counts();
  ++this->Surfaces;
  this->SolverOfMeshes.reset();
  this->OwnSurface.reset();
  this->Digest.clear();
  if (!AreAllOfMpi(ranks))
  {
    return "the ranks of VTK's controller are not those of MPI";
  }
  const Stopwatch watch;
  SurfacePiece piece;
  std::optional<SurfaceMesh> mesh = MeshOfPiece(ranks, input, preparation, piece, PartOfContext(context, 0.0, 0.4));
  AgreeOnSeams(ranks, isEmpty ? nullptr : &mesh->Mesh, RoundOffOfPoints(input), piece.Positions);
  this->Reason.clear();
  this->OwnRelation =
    mesh ? std::move(static_cast<SurfaceRelation&>(*mesh)) : SurfaceRelation(); // the solver keeps its names
  this->PreparationOfPiece = mesh ? mesh->Report : PreparationReport();
  try
  {
    this->SolverOfMeshes = std::make_unique<FieldSolverInPieces>(
      MPI_COMM_WORLD, piece, this->OwnRelation.Names(), PartOfContext(context, 0.4, 1.0));
  }
  catch (const InvalidInput& error) // of all ranks
  {
    this->Reason = std::string("the pieces cannot be joined where they are: ") + error.what();
  }
  if (this->SolverOfMeshes)
  {
    this->OwnRelation.SetPlaces(FirstsOf(this->SolverOfMeshes->Piece().VerticesOfPoints()));
    ranks.Together(
      [&]
      {
        if (!isEmpty)
        {
          this->OwnGeometry = std::make_unique<const FramedMesh>(std::move(mesh->Mesh), context);
          this->OwnSurface.emplace(FramedSurface{ *this->OwnGeometry, this->OwnRelation });
        }
        this->Relate(static_cast<int>(input->GetNumberOfCells()), static_cast<int>(input->GetNumberOfPoints()));
      });
  }
  this->SurfaceSeconds = watch.Seconds();
  this->Digest = digest;
  return this->Reason;
}

void SolverOfPieces::Relate(int numberOfCells, int numberOfPoints)
{
  const PieceOfSurface& part = this->SolverOfMeshes->Piece();
  const SurfaceRelation& piece = this->OwnRelation;
  const TriangleMesh& mesh = part.Surface().Mesh;
  std::vector<int> cells(mesh.NumberOfFaces(), -1);
  for (int triangle = 0; triangle < part.NumberOfOwnFaces(); ++triangle)
  {
    cells[part.FirstOwnFace() + triangle] = piece.CellOf(triangle);
  }
  const std::vector<int>& vertices = part.VerticesOfPoints();
  std::vector<int> points(mesh.NumberOfVertices(), -1);
  for (int k = static_cast<int>(vertices.size()) - 1; k >= 0; --k)
  {
    if (vertices[k] >= 0)
    {
      points[vertices[k]] = piece.PointOf(k);
    }
  }
  ElementRows faces;
  faces.Offsets.push_back(0);
  for (int cell = 0; cell < numberOfCells; ++cell)
  {
    for (const int triangle : piece.FacesOf(cell))
    {
      faces.Items.push_back(part.FirstOwnFace() + triangle);
    }
    faces.Offsets.push_back(static_cast<int>(faces.Items.size()));
  }
  ElementRows verticesOfPoints;
  verticesOfPoints.Offsets.push_back(0);
  for (int point = 0; point < numberOfPoints; ++point)
  {
    for (const int k : piece.VerticesOf(point))
    {
      if (vertices[k] >= 0)
      {
        verticesOfPoints.Items.push_back(vertices[k]);
      }
    }
    verticesOfPoints.Offsets.push_back(static_cast<int>(verticesOfPoints.Items.size()));
  }
  this->Relation =
    SurfaceRelation(0, std::move(cells), std::move(faces), std::move(points), std::move(verticesOfPoints));
}

StageCounts SolverOfPieces::Counts() const
{
  return this->SolverOfMeshes ? this->FormerCounts + this->SolverOfMeshes->Counts() : this->FormerCounts;
}

double SolverOfPieces::SetupSeconds(const Field& field) const
{
  return this->SurfaceSeconds + field.Solution->SetupSeconds;
}

}
