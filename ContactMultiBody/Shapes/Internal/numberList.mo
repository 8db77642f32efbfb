within ContactMultiBody.Shapes.Internal;
pure function numberList "Numbers, separated by commas, that read back exactly"
  extends Modelica.Icons.Function;
  input Real numbers[:] "Numbers";
  output String list "Text";
algorithm
  list := String(numbers[1], significantDigits=17);
  for i in 2:size(numbers, 1) loop
    list := list + "," + String(numbers[i], significantDigits=17);
  end for;
  annotation (Documentation(info="<html>
<p>Seventeen digits identify every double precision number.</p>
</html>"));
end numberList;
