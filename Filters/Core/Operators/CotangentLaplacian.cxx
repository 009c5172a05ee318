#include "Operators/CotangentLaplacian.h"

#include "Operators/ExteriorCalculus.h"
#include "Support/SparseAssembly.h"

namespace dmg
{

SparseMatrix<double> CotangentLaplacian(
  const TriangleMesh& mesh, const ExecutionContext& context, const std::vector<double>& conductivity)
{
  Vector<double> star1 = Star1(mesh);
  for (int edge = 0; edge < mesh.NumberOfEdges() && !conductivity.empty(); ++edge)
  {
    const int h = mesh.HalfedgeOf(edge);
    star1[edge] *= 0.5 * (conductivity[mesh.Tail(h)] + conductivity[mesh.Head(h)]);
  }
  return AssembleMatrix<double>(mesh.NumberOfVertices(), mesh.NumberOfVertices(), context,
    [&](int vertex, RowEntries<double>& row)
    {
      row.emplace_back(vertex, 0.0);
      const auto addEdge = [&](int halfedge, int other)
      {
        const double weight = star1[mesh.EdgeOf(halfedge)];
        row.front().second += weight;
        AddTo(row, other, -weight);
      };
      mesh.VisitFan(vertex,
        [&](int h)
        {
          addEdge(h, mesh.Head(h));
          if (const int last = TriangleMesh::Previous(h); mesh.Twin(last) < 0)
          {
            addEdge(last, mesh.Tail(last));
          }
        });
    });
}

}
