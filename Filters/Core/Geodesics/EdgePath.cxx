#include "Geodesics/EdgePath.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace dmg
{
namespace
{

/// Angles that are less than pi by no more than this are straight.
constexpr double Rounding = 1e-9;

class FlipOut
{
public:
  FlipOut(EdgePath& path, IntrinsicTriangulation& surface)
    : Steps(path.Steps)
    , Surface(surface)
  {
  }

  void Run(const ExecutionContext& context)
  {
    constexpr int MostBends = 100'000; // rounding could change one for ever
    constexpr int Interval = 64;
    for (int bend = 0; bend < MostBends; ++bend)
    {
      if (bend % Interval == 0)
      {
        context.Checkpoint(0.0);
      }
      const std::optional<Wedge> sharpest = this->Sharpest();
      if (!sharpest)
      {
        return;
      }
      this->GoAround(*sharpest);
    }
  }

private:
  using Step = EdgePath::Step;
  /// The triangles at a vertex of the path, on one of its sides.
  struct Wedge
  {
    int Joint;    ///< the number of the step that arrives there
    bool IsRight; ///< of the path
    double Angle;
    std::vector<int> Fan; ///< halfedges from the vertex, counter-clockwise, from the step that leaves it on the left
  };

  /// The steps at a joint such that the wedge is on their left.
  std::array<Step, 2> StepsAt(int joint, bool isRight) const
  {
    const Step& in = this->Steps[joint];
    const Step& out = this->Steps[joint + 1];
    return isRight ? std::array<Step, 2>{ out.Reversed(), in.Reversed() } : std::array<Step, 2>{ in, out };
  }

  /// Its angle is infinite where it contains the boundary or a held edge.
  Wedge WedgeAt(int joint, bool isRight) const
  {
    Wedge wedge{ joint, isRight, 0.0, {} };
    const auto [in, out] = this->StepsAt(joint, isRight);
    const bool isBack = in.Along == out.Against && in.Against == out.Along;
    for (int h = out.Along; !isBack; h = this->Surface.Twin(TriangleMesh::Previous(h)))
    {
      const bool isBarred = h < 0 || (!wedge.Fan.empty() && this->Surface.IsHeld(h));
      if (isBarred || wedge.Angle > Pi)
      {
        wedge.Angle = std::numeric_limits<double>::infinity();
        break;
      }
      wedge.Fan.push_back(h);
      wedge.Angle += this->Surface.CornerAngle(h);
      if (TriangleMesh::Previous(h) == in.Along)
      {
        break;
      }
    }
    return wedge;
  }

  std::optional<Wedge> Sharpest() const
  {
    std::optional<Wedge> sharpest;
    for (int joint = 0; joint + 1 < static_cast<int>(this->Steps.size()); ++joint)
    {
      for (const bool isRight : { false, true })
      {
        Wedge wedge = this->WedgeAt(joint, isRight);
        if (wedge.Angle < (sharpest ? sharpest->Angle : Pi - Rounding))
        {
          sharpest = std::move(wedge);
        }
      }
    }
    return sharpest;
  }

  /// Takes the far side of a wedge, after edges inside it that bend inwards there have been flipped out of it.
  void GoAround(Wedge wedge)
  {
    while (this->FlipOne(wedge.Fan))
    {
      wedge = this->WedgeAt(wedge.Joint, wedge.IsRight);
    }
    std::vector<Step> around;
    for (const int h : wedge.Fan)
    {
      const int side = TriangleMesh::Next(h);
      around.push_back({ side, this->Surface.Twin(side) });
    }
    if (!wedge.IsRight) // the wedge runs from the step that leaves to the one that arrives
    {
      std::reverse(around.begin(), around.end());
      std::transform(around.begin(), around.end(), around.begin(), [](const Step& step) { return step.Reversed(); });
    }
    const auto joint = this->Steps.erase(this->Steps.begin() + wedge.Joint, this->Steps.begin() + wedge.Joint + 2);
    this->Steps.insert(joint, around.begin(), around.end());
  }

  bool FlipOne(const std::vector<int>& fan)
  {
    for (std::size_t k = 1; k < fan.size(); ++k)
    {
      const int h = fan[k];
      const double beyond =
        this->Surface.CornerAngle(TriangleMesh::Next(h)) + this->Surface.CornerAngle(this->Surface.Twin(h));
      if (beyond < Pi - Rounding && this->Surface.HasOtherDiagonal(h))
      {
        this->Flip(h);
        return true;
      }
    }
    return false;
  }

  void Flip(int h)
  {
    const int twin = this->Surface.Twin(h);
    const std::array<int, 4> from = { TriangleMesh::Previous(h), TriangleMesh::Next(twin), TriangleMesh::Previous(twin),
      TriangleMesh::Next(h) };
    const std::array<int, 4> to = this->Surface.Flip(h);
    const auto renumber = [&](int& halfedge)
    {
      const auto found = std::find(from.begin(), from.end(), halfedge);
      halfedge = found == from.end() ? halfedge : to[found - from.begin()];
    };
    for (Step& step : this->Steps)
    {
      renumber(step.Along);
      renumber(step.Against);
    }
  }

  std::vector<Step>& Steps;
  IntrinsicTriangulation& Surface;
};

}

double EdgePath::Length(const IntrinsicTriangulation& surface) const
{
  double length = 0.0;
  for (const Step& step : this->Steps)
  {
    length += surface.Length(step.Along >= 0 ? step.Along : step.Against);
  }
  return length;
}

void MakeShortest(EdgePath& path, IntrinsicTriangulation& surface, const ExecutionContext& context)
{
  FlipOut(path, surface).Run(context);
}

}
