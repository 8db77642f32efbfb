within ContactMultiBodyTest;
package Rest "Bodies that come to rest, or stay there"
  extends Modelica.Icons.ExamplesPackage;

  annotation (Documentation(info="<html>
<p>Where a body rests, what carries it, and that nothing gains energy.</p>
</html>"));
end Rest;
