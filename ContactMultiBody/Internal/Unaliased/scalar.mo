within ContactMultiBody.Internal.Unaliased;
pure function scalar "A number under another name"
  extends Modelica.Icons.Function;
  input Real u "Number";
  output Real y "The same number";
algorithm
  y := u;
  annotation (Inline=false, Documentation(info="<html>
<p>See the package.</p>
</html>"));
end scalar;
