#include "Prolongation/NodalProlongation.h"

#include "Support/SparseAssembly.h"

#include <utility>

namespace dmg
{

namespace
{

using Row = std::vector<std::pair<int, Complex>>; // columns and entries

}

TransportOperator VerticesFromVertices(const SparseMatrix<double>& S0,
  const TangentFrames& fineVertexFrames, const TangentFrames& coarseVertexFrames,
  const ExecutionContext& context)
{
  const auto appendRow = [&](int vertex, Row& row) {
    for (SparseMatrix<double>::InnerIterator entry(S0, vertex); entry; ++entry)
    {
      const int column = static_cast<int>(entry.col());
      row.emplace_back(
        column, entry.value() * TransportTurn(coarseVertexFrames, column, fineVertexFrames, vertex));
    }
  };
  return ToMatrix(AssembleRows<Complex>(static_cast<int>(S0.rows()), context, appendRow),
    static_cast<int>(S0.cols()));
}

TransportOperator FacesFromVertices(const TriangleMesh& fine, const SparseMatrix<double>& S0,
  const TangentFrames& fineFaceFrames, const TangentFrames& coarseVertexFrames,
  const ExecutionContext& context)
{
  const auto appendRow = [&](int face, Row& row) {
    for (int k = 0; k < 3; ++k)
    {
      for (SparseMatrix<double>::InnerIterator entry(S0, fine.FaceCorners()(face, k)); entry; ++entry)
      {
        const int column = static_cast<int>(entry.col());
        const auto found = std::find_if(
          row.begin(), row.end(), [column](const auto& e) { return e.first == column; });
        if (found == row.end())
        {
          row.emplace_back(column, entry.value() / 3.0);
        }
        else
        {
          found->second += entry.value() / 3.0;
        }
      }
    }
    for (auto& [column, entry] : row)
    {
      entry *= TransportTurn(coarseVertexFrames, column, fineFaceFrames, face);
    }
  };
  return ToMatrix(AssembleRows<Complex>(fine.NumberOfFaces(), context, appendRow),
    static_cast<int>(S0.cols()));
}

}
