#include "ProblemsInPieces.h"

#include "Support/ComplexPairs.h"

#include <vector>

namespace dmg::test
{

namespace
{

/// The numbers that elements of the whole surface have in a piece, -1 where they are not there.
std::vector<int> NumbersInPiece(const std::vector<int>& ofPiece, Eigen::Index size)
{
  std::vector<int> numbers(size, -1);
  for (std::size_t i = 0; i < ofPiece.size(); ++i)
  {
    numbers[ofPiece[i]] = static_cast<int>(i);
  }
  return numbers;
}

template <class Item>
std::vector<Item> InPiece(const std::vector<Item>& whole, int Item::*element, const std::vector<int>& numbers)
{
  std::vector<Item> here;
  for (Item item : whole)
  {
    item.*element = numbers[item.*element];
    if (item.*element >= 0)
    {
      here.push_back(item);
    }
  }
  return here;
}

}

dmg::FieldProblem OfPiece(const dmg::FieldProblem& whole, const CutPiece& cut, const Surface& surface)
{
  const std::vector<int> triangles = NumbersInPiece(cut.Triangles, surface.F.rows());
  const std::vector<int> points = NumbersInPiece(cut.Points, surface.V.rows());
  dmg::FieldProblem here = whole;
  here.Constraints.OnFaces = InPiece(whole.Constraints.OnFaces, &Constraint::Element, triangles);
  here.Constraints.AtVertices = InPiece(whole.Constraints.AtVertices, &Constraint::Element, points);
  here.Constraints.Values = InPiece(whole.Constraints.Values, &ValueConstraint::Vertex, points);
  const auto choose = [](const Vector<double>& all, const std::vector<int>& chosen)
  { return all.size() > 0 ? Vector<double>(all(chosen)) : all; };
  here.Constraints.Source = choose(whole.Constraints.Source, cut.Points);
  here.Rotation.Faces = choose(whole.Rotation.Faces, cut.Triangles);
  here.Rotation.Vertices = choose(whole.Rotation.Vertices, cut.Points);
  return here;
}

Vector<Complex> UnknownsOf(const dmg::Field& field)
{
  const Vector<double>& unknowns = field.Solution->Unknowns;
  return field.Solution->Discretisation->UnknownsPerElement() == 1 ? Vector<Complex>(unknowns.cast<Complex>())
                                                                   : Vector<Complex>(AsComplex(unknowns));
}

}
