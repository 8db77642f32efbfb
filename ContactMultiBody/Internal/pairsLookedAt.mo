within ContactMultiBody.Internal;
pure function pairsLookedAt "The pairs given, or all pairs of n bodies where none is given"
  extends Modelica.Icons.Function;
  input Integer given[:, 2] "Bodies of each pair, empty for all pairs";
  input Integer n "Number of bodies";
  input Integer m "Number of pairs";
  output Integer pairs[m, 2] "Bodies of each pair";
protected
  Integer a=1 "First body of the pair where all are looked at";
  Integer b=1 "Second body of the pair where all are looked at";
algorithm
  pairs := fill(0, m, 2);
  for i in 1:m loop
    a := if b < n then a else a + 1;
    b := if b < n then b + 1 else a + 1;
    pairs[i, 1] := if size(given, 1) > 0 then given[i, 1] else a;
    pairs[i, 2] := if size(given, 1) > 0 then given[i, 2] else b;
    assert(pairs[i, 1] >= 1 and pairs[i, 1] <= n and pairs[i, 2] >= 1 and pairs[i, 2] <= n and pairs[i, 1] <> pairs[i, 2],
      "ContactManager: row " + String(i) + " of pairs is {" + String(pairs[i, 1]) + "," + String(pairs[i, 2]) +
      "}; give two different numbers between 1 and n = " + String(n) + ".");
  end for;
  annotation (Documentation(info="<html>
<p>Rows {1,2}, {1,3}, ..., {2,3}, ... where all pairs are looked at.</p>
</html>"));
end pairsLookedAt;
