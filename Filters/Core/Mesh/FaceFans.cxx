#include "Mesh/FaceFans.h"

#include <algorithm>
#include <utility>

namespace dmg
{
namespace
{

/// A greedy traversal: it goes from an item that is taken to its neighbours, and starts anew where these end.
/// \param take(item) called once for each; returns whether the item is taken.
/// \param forNext(item, visit) calls visit(next) for where to go from an item that has been taken.
template <class Take, class ForNext>
void TakeOutwards(int items, const Take& take, const ForNext& forNext)
{
  std::vector<char> isSeen(items, 0);
  std::vector<int> queue;
  const auto enter = [&isSeen, &queue](int item)
  {
    if (!isSeen[item])
    {
      isSeen[item] = 1;
      queue.push_back(item);
    }
  };
  for (int seed = 0; seed < items; ++seed)
  {
    queue.clear();
    enter(seed);
    for (std::size_t k = 0; k < queue.size(); ++k)
    {
      if (const int item = queue[k]; take(item))
      {
        forNext(item, enter);
      }
    }
  }
}

class FanPacker
{
public:
  FanPacker(const TriangleMesh& mesh, int largest)
    : Mesh(mesh)
    , Largest(largest)
    , IsFree(mesh.NumberOfFaces(), 1)
  {
    this->Fans.Faces.reserve(mesh.NumberOfFaces());
  }

  FaceFans Pack()
  {
    this->PackStars();
    this->PackLongest();
    return std::move(this->Fans);
  }

private:
  void PackStars()
  {
    TakeOutwards(
      this->Mesh.NumberOfVertices(), [this](int vertex) { return this->TakeStar(vertex); },
      [this](int vertex, const auto& visit)
      {
        this->Mesh.VisitFan(vertex,
          [&](int h)
          {
            if (const int beyond = this->Mesh.Twin(TriangleMesh::Next(h)); beyond >= 0)
            {
              visit(this->Mesh.Tail(TriangleMesh::Previous(beyond)));
            }
          });
      });
  }

  bool TakeStar(int vertex)
  {
    this->CollectStar(vertex);
    const auto isFree = [this](int face) { return this->IsFree[face] != 0; };
    if (!this->IsClosed || static_cast<int>(this->Star.size()) > this->Largest ||
      !std::all_of(this->Star.begin(), this->Star.end(), isFree))
    {
      return false;
    }
    this->Take(0, static_cast<int>(this->Star.size()));
    return true;
  }

  /// Vertices wait by the length of their longest fan, which only gets shorter.
  void PackLongest()
  {
    std::vector<std::vector<int>> waiting(this->Largest + 1);
    for (int vertex = 0; vertex < this->Mesh.NumberOfVertices(); ++vertex)
    {
      this->CollectStar(vertex);
      waiting[this->LongestFan().Length].push_back(vertex);
    }
    for (int length = this->Largest; length > 0; --length)
    {
      for (std::size_t k = 0; k < waiting[length].size(); ++k)
      {
        const int vertex = waiting[length][k];
        this->CollectStar(vertex);
        Run fan = this->LongestFan();
        while (fan.Length == length)
        {
          this->Take(fan.Begin, fan.Length);
          fan = this->LongestFan();
        }
        waiting[fan.Length].push_back(vertex);
      }
    }
  }

  void CollectStar(int vertex)
  {
    this->Star.clear();
    this->Mesh.VisitFan(vertex, [this](int h) { this->Star.push_back(TriangleMesh::FaceOf(h)); });
    this->IsClosed = !this->Mesh.IsBoundaryVertex(vertex);
  }

  /// Free faces of the star, from the one at Begin on, beyond the last one to the first where it is closed.
  struct Run
  {
    int Begin;
    int Length;
  };
  /// The first of the longest; no longer than a fan may be.
  Run LongestFan() const
  {
    const int size = static_cast<int>(this->Star.size());
    Run longest = { 0, 0 };
    for (int begin = 0; begin < size; ++begin)
    {
      const int most = std::min(this->Largest, this->IsClosed ? size : size - begin);
      int length = 0;
      while (length < most && this->IsFree[this->Star[(begin + length) % size]])
      {
        ++length;
      }
      if (length > longest.Length)
      {
        longest = { begin, length };
      }
    }
    return longest;
  }

  void Take(int begin, int length)
  {
    for (int k = begin; k < begin + length; ++k)
    {
      const int face = this->Star[k % this->Star.size()];
      this->IsFree[face] = 0;
      this->Fans.Faces.push_back(face);
    }
    this->Fans.Offsets.push_back(static_cast<int>(this->Fans.Faces.size()));
  }

  const TriangleMesh& Mesh;
  const int Largest;
  std::vector<char> IsFree;
  std::vector<int> Star; ///< faces around a vertex
  bool IsClosed = false;
  FaceFans Fans;
};

}

FaceFans PackFans(const TriangleMesh& mesh, int largest)
{
  return FanPacker(mesh, largest).Pack();
}

std::vector<int> PackFaces(const TriangleMesh& mesh)
{
  std::vector<char> hasTakenSide(mesh.NumberOfFaces(), 0);
  std::vector<int> taken;
  TakeOutwards(
    mesh.NumberOfFaces(),
    [&](int face)
    {
      if (hasTakenSide[face])
      {
        return false;
      }
      taken.push_back(face);
      mesh.VisitNeighbours(face, [&hasTakenSide](int neighbour) { hasTakenSide[neighbour] = 1; });
      return true;
    },
    [&](int face, const auto& visit)
    { mesh.VisitNeighbours(face, [&](int neighbour) { mesh.VisitNeighbours(neighbour, visit); }); });
  return taken;
}

}
