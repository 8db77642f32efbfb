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
  Integer first "First body of a pair";
  Integer second "Second body of a pair";
algorithm
  assert(n >= 2, "ContactManager: n = " + String(n) + ", and a contact takes two bodies; connect at least two, as a body and a Parts.Ground, or leave the manager out.");
  pairs := fill(0, m, 2);
  for i in 1:m loop
    a := if b < n then a else a + 1;
    b := if b < n then b + 1 else a + 1;
    first := if size(given, 1) > 0 then given[i, 1] else a;
    second := if size(given, 1) > 0 then given[i, 2] else b;
    assert(first >= 1 and first <= n and second >= 1 and second <= n and first <> second,
      "ContactManager: row " + String(i) + " of pairs is {" + String(first) + "," + String(second) +
      "}; give two different numbers between 1 and n = " + String(n) + ".");
    // Tools that look at assertions last index with the pairs before: this message is clearer than an index out of bounds.
    pairs[i, 1] := max(1, min(n, first));
    pairs[i, 2] := max(1, min(n, second));
  end for;
  annotation (Inline=false, Documentation(info="<html>
<p>Rows {1,2}, {1,3}, ..., {2,3}, ... where all pairs are looked at.</p>
</html>"));
end pairsLookedAt;
